// The contract of a plug-in: every field has a fault that it excuses, and one that it does not.
#include "properties/claims/contract.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/judging/trial.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using test::plugin;

struct FoundByContract {
  std::map<Outcome, int> outcomes;
  std::map<std::string, int> kinds;  // "late", ...
  StepMeasures measures;
  Contract contract;
  std::uint64_t discards = 0;
  std::string explanation;  // of the first defect
};

// Cases of every family through the plug-in by_contract with these words.
FoundByContract found_by(const std::string& words, std::uint64_t cases_a_family = 12) {
  ::setenv("ASSAY_BY_CONTRACT", words.c_str(), 1);
  WorkerProcess worker(ASSAY_WORKER, plugin("by_contract"), {.seconds = 20});
  FoundByContract found;
  const auto description = worker.describe();
  if (!description) {
    ADD_FAILURE() << words << ": " << description.error().message;
    return found;
  }
  DetectorUnderTest detector;
  detector.name = description.value().name;
  detector.built_in = false;
  detector.claims = description.value().claims;
  detector.contract = found.contract = description.value().contract;
  detector.configurations = {{"plug-in", {}}};
  for (const auto& family : families()) {
    for (std::uint64_t i = 0; i < cases_a_family; ++i) {
      const auto planned =
          case_within(detector.contract, family,
                      "contract:1:" + std::string(family.name) + ":" + std::to_string(i));
      found.measures.redrawn += planned.redrawn;
      found.measures.steps_left_out += planned.steps_left_out;
      if (!planned.seen) {
        ++found.discards;
        continue;
      }
      const auto truth = judge_case(*planned.seen, detector.contract);
      const auto runs = worker.run(*planned.seen, detector.configurations);
      const auto verdict =
          judge_trial(*planned.seen, truth, runs[0], detector.configurations[0], detector);
      ++found.outcomes[verdict.outcome];
      found.measures += measures_of(verdict.steps, runs[0].steps);
      if (!verdict.failure) continue;
      ++found.kinds[verdict.failure->kind];
      if (found.explanation.empty())
        found.explanation = verdict.failure->signature() + "; " + verdict.failure->explanation;
    }
  }
  return found;
}

void expect_excused(const std::string& words) {
  auto found = found_by(words);
  EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.explanation;
  EXPECT_GT(found.outcomes[Outcome::holds], 80) << words;
  EXPECT_EQ(found.discards, 0u) << words;
}

void expect_defect(const std::string& words, const std::string& kind) {
  auto found = found_by(words);
  EXPECT_GT(found.outcomes[Outcome::defect], 0) << words;
  EXPECT_GT(found.kinds[kind], 0) << words << ": " << found.explanation;
}

TEST(Contract, WithoutOneTheDetectorHoldsAndItsFaultsAreFound) {
  expect_excused("");
  expect_defect("miss-at-start", "answered free");
  expect_defect("miss-inside", "answered free");
  expect_defect("late=1e-6", "late");
  expect_defect("early=1e-6", "early");
  expect_defect("alarm=2", "answered collision");
  expect_defect("miss=edge-edge", "answered free");
}

TEST(Contract, AFreeStartExcusesContactsAtTheStartAlone) {
  expect_excused("start=free miss-at-start abort-outside");
  expect_defect("start=free miss-inside", "answered free");
}

TEST(Contract, AStartApartExcusesContactsAtTheStartAlone) {
  expect_excused("start=apart:1e-12 miss-at-start");
  expect_defect("start=apart:1e-12 miss-inside", "answered free");
}

TEST(Contract, ARangeExcusesWhatIsBeyondIt) {
  expect_excused("range=1e-6:1e6 abort-outside");
  expect_defect("range=1e-6:1e6 miss-inside", "answered free");
}

TEST(Contract, FeaturesThatAreNotTestedAreExcused) {
  expect_excused("features=vertex-face");
  expect_excused("features=edge-edge");
  expect_defect("features=vertex-face miss=vertex-face", "answered free");
  expect_defect("features=edge-edge miss=edge-edge", "answered free");
}

TEST(Contract, AToleranceExcusesTimesWithinIt) {
  expect_excused("tolerance=1e-6 late=1e-7");
  expect_excused("tolerance=1e-6 early=1e-7");
  expect_defect("tolerance=1e-6 late=1e-5", "late");
  expect_defect("tolerance=1e-6 early=1e-5", "early");
}

TEST(Contract, NoPairsExcusesThatThereAreNoneButNotThatThereAre) {
  expect_excused("no-pairs");
  expect_defect("no-pairs with-pairs", "error");
  // Not a word of missing pairs.
  auto found = found_by("no-pairs miss-inside");
  EXPECT_EQ(found.kinds.count("missing pair"), 0u);
  EXPECT_GT(found.kinds["answered free"], 0);
}

TEST(Contract, AMarginExcusesAlarmsButNoMiss) {
  expect_excused("margin=0.1 alarm=2");
  expect_defect("margin=0.1 miss-inside", "answered free");
}

TEST(Contract, LeavesOutAndCounts) {
  const auto found = found_by("start=free");
  const auto& measures = found.measures;
  EXPECT_GT(measures.steps_left_out + measures.redrawn, 0u);
  EXPECT_GT(measures.errors.contact, 30u);
  const auto& errors = measures.errors;
  EXPECT_EQ(errors.late.steps + errors.early.steps + errors.false_alarms, 0u);
}

TEST(Contract, CountsAlarmsAndTimesThatNobodyClaimed) {
  constexpr const char* total_alone = "claims=128 ";
  const auto alarms = found_by(std::string(total_alone) + "whenever").measures;
  EXPECT_GT(alarms.errors.free, 20u);
  EXPECT_EQ(alarms.errors.false_alarms, alarms.errors.free);
  EXPECT_EQ(alarms.without_time, alarms.errors.collisions());
  const auto late = found_by(std::string(total_alone) + "late=1e-3").measures.errors;
  EXPECT_GT(late.late.steps, 30u);
  EXPECT_NEAR(late.late.worst_share, 1e-3, 1e-4);
  EXPECT_EQ(late.early.steps, 0u);
}

TEST(Contract, WhatIsSenselessIsRefusedInOneLine) {
  const std::map<std::string, std::string> senseless = {
      {"range=1:0.5", "upside down"},
      {"tolerance=0.01", "is above 0.001"},
      {"tolerance=nan", "no time"},
      {"start=apart:0", "start_distance of 0"},
      {"start=apart:-1", "is no length"},
      {"range=-1:1", "range of coordinates is none"},
      {"margin=inf", "its margin is no length"}};
  for (const auto& [words, line] : senseless) {
    ::setenv("ASSAY_BY_CONTRACT", words.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, plugin("by_contract"));
    const auto description = worker.describe();
    ASSERT_FALSE(description) << words;
    EXPECT_TRUE(says(description.error(), line)) << words;
  }
}

}  // namespace
}  // namespace assay::properties
