// A library of candidates alone: judged by the pairs that it loses, and nothing else.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/judging/trial.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using test::plugin;

struct FoundInCandidates {
  std::map<Outcome, int> outcomes;
  std::map<std::string, int> signatures, explanations;
  StepMeasures measures;
};

// Cases of every family through the plug-in candidates_alone with this fault, each twice.
FoundInCandidates found_with(const char* fault, std::uint64_t threads = 1) {
  ::setenv("ASSAY_CANDIDATES", fault, 1);
  WorkerProcess worker(ASSAY_WORKER, plugin("candidates_alone"),
                       {.seconds = 20, .threads = threads});
  FoundInCandidates found;
  const auto description = worker.describe();
  if (!description) {
    ADD_FAILURE() << fault << ": " << description.error().message;
    return found;
  }
  DetectorUnderTest detector;
  detector.name = description.value().name;
  detector.built_in = false;
  detector.claims = claims_on_steps(description.value());
  detector.configurations = {{"plug-in", {}}};
  for (const auto& family : families()) {
    for (std::uint64_t i = 0; i < 6; ++i) {
      const auto planned = case_within(
          {}, family, "candidates:1:" + std::string(family.name) + ":" + std::to_string(i));
      const auto truth = judge_case(*planned.seen, detector.contract);
      const auto runs = worker.run(*planned.seen, detector.configurations);
      const auto again = worker.run(*planned.seen, detector.configurations);
      const auto verdict = judge_trial(*planned.seen, truth, runs[0], detector.configurations[0],
                                       detector, &again[0]);
      ++found.outcomes[verdict.outcome];
      found.measures += measures_of(verdict.steps, runs[0].steps);
      if (!verdict.failure) continue;
      ++found.signatures[verdict.failure->signature()];
      ++found.explanations[verdict.failure->explanation];
    }
  }
  return found;
}

TEST(Candidates, OfBoxesOverTheWholeStepHold) {
  auto found = found_with("");
  EXPECT_EQ(found.outcomes[Outcome::defect], 0) << found.signatures.begin()->first;
  EXPECT_EQ(found.outcomes[Outcome::holds], static_cast<int>(6 * families().size()));
  EXPECT_GT(found.measures.candidate_steps, 40u);
  EXPECT_GT(found.measures.least_candidates, 100u);
  EXPECT_GT(found.measures.candidates, found.measures.least_candidates);
  EXPECT_EQ(found.measures.errors.answered(), 0u) << "it answers none";
}

TEST(Candidates, ThatMissAContactAreFoundWithItsCause) {
  for (const char* fault : {"ends-only", "every-second"}) {
    auto found = found_with(fault);
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << fault;
    EXPECT_GT(found.outcomes[Outcome::holds], 0) << fault;
    for (const auto& [signature, count] : found.signatures)
      EXPECT_TRUE(signature.starts_with("candidates: missing candidate, ")) << signature;
    const auto& signature = found.signatures.begin()->first;
    EXPECT_NE(signature.find(", t "), std::string::npos) << signature;
    EXPECT_NE(found.explanations.begin()->first.find(" candidates"), std::string::npos);
  }
}

TEST(Candidates, ThatChangeAreNotDeterministic) {
  auto found = found_with("changing");
  EXPECT_GT(found.signatures["deterministic: two runs differ"], 0);
  EXPECT_EQ(found.signatures.size(), 1u) << found.signatures.begin()->first;
}

TEST(Candidates, ThatAreNoneBreakTotal) {
  for (const char* fault : {"no-such-triangle", "no-list", "fail", "abort"}) {
    auto found = found_with(fault);
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << fault;
    for (const auto& [signature, count] : found.signatures)
      EXPECT_TRUE(signature.starts_with("total: ")) << fault << ": " << signature;
  }
}

TEST(Candidates, WithoutMemoryAreUndecided) {
  auto found = found_with("no-memory");
  EXPECT_EQ(found.outcomes[Outcome::undecided], static_cast<int>(6 * families().size()));
}

TEST(Candidates, AreToldHowManyThreadsTheyMayUse) {
  auto found = found_with("threads=3", 3);
  EXPECT_EQ(found.outcomes[Outcome::defect], 0);
  found = found_with("threads=3", 1);
  EXPECT_GT(found.outcomes[Outcome::defect], 0) << "the default is 1";
}

}  // namespace
}  // namespace assay::properties
