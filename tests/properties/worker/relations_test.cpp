// Which pairs count (L19), from the case to the detector and back: the built-in detector in the
// worker; plug-ins that can be told, that leave out pairs by themselves, or that cannot be told.
#include "detector/plugin/assay_builtin_detector.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/worker/plugin/plugin_host.h"
#include "properties/worker/worker_process.h"
#include "tests/curated_cases.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using test::plugin, test::plugin_alone;

std::vector<corpus::Case> counted_cases(int count) {
  std::vector<corpus::Case> cases = {tests::curated_case("F_ignored_contact")};
  const Family& family = counted_families()[0];
  for (int i = 0; i < count; ++i)
    cases.push_back(make_case(family, "relations:1:counted:" + std::to_string(i)).c);
  return cases;
}

TEST(Relations, L19_TheWorkerIsToldWhichPairsCount) {
  WorkerProcess worker(ASSAY_WORKER, std::nullopt);
  const std::vector<Configuration> two = {{"view-point", {detector::Culling::view_point}},
                                          {"bvh", {detector::Culling::bvh}}};
  std::size_t differ = 0;
  for (const auto& c : counted_cases(100)) {
    auto all = c;
    all.counted.reset();
    const auto runs = worker.run(c, two);
    for (std::size_t k = 0; k < two.size(); ++k) {
      ASSERT_EQ(runs[k].end, RunEnd::completed) << c.id << ": " << runs[k].explanation;
      EXPECT_TRUE(same_answers(runs[k], run_case(c, two[k]))) << c.id;
      differ += same_answers(runs[k], run_case(all, two[k])) ? 0 : 1;
    }
  }
  EXPECT_GT(differ, 50u);
}

struct ToldRuns {
  std::map<Outcome, int> outcomes;
  std::map<Claim, int> broken;
  std::size_t left_out_misses = 0, left_out = 0;
  Contract contract;
  std::string explanation;
};

ToldRuns runs_told(const std::string& words, const std::vector<corpus::Case>& cases,
                   const std::string& name = "takes_relations") {
  ::setenv("ASSAY_TAKES_RELATIONS", words.c_str(), 1);
  WorkerProcess worker(ASSAY_WORKER, plugin(name), {.seconds = 20});
  const auto description = worker.describe();
  ToldRuns tally;
  if (!description) {
    ADD_FAILURE() << description.error().message;
    return tally;
  }
  tally.contract = description.value().contract;
  const DetectorUnderTest told{name, false, description.value().claims, tally.contract,
                               plugin_alone};
  for (const auto& c : cases) {
    const auto seen = contract_case(c, tally.contract);
    if (!seen) continue;
    const auto examined = examine({told, plugin_alone, &worker}, *seen);
    const auto& run = examined.runs[0];
    const auto& verdict = examined.verdicts[0];
    ++tally.outcomes[verdict.outcome];
    for (const auto claim : verdict.breaches) ++tally.broken[claim];
    tally.left_out_misses += verdict.left_out_misses;
    for (const auto& step : verdict.steps) tally.left_out += step.left_out.size();
    if (!run.explanation.empty()) tally.explanation = run.explanation;
  }
  ::unsetenv("ASSAY_TAKES_RELATIONS");
  return tally;
}

TEST(Relations, L19_APlugInIsToldWhichPairsCount) {
  const auto cases = counted_cases(150);
  auto told = runs_told("", cases);
  EXPECT_TRUE(told.contract.takes_relations);
  EXPECT_EQ(told.outcomes[Outcome::holds], static_cast<int>(cases.size())) << told.explanation;
  // Who goes on as if all pairs counted reports pairs that do not.
  auto ignores = runs_told("ignores", cases);
  EXPECT_GT(ignores.broken[Claim::no_spurious], 30);
  EXPECT_EQ(ignores.broken[Claim::free_sound], 0);
  // Who does not take a relation refuses its case, in its own words.
  auto refuses = runs_told("refuses", cases);
  EXPECT_GT(refuses.broken[Claim::total], 10);
  EXPECT_EQ(refuses.explanation, "count returned 1: bodies are not taken");
}

TEST(Relations, L19_APlugInThatCannotBeToldIsAskedAboutAllPairs) {
  const auto cases = counted_cases(80);
  auto told = runs_told("", cases, "wrapped_builtin");
  EXPECT_FALSE(told.contract.takes_relations);
  EXPECT_EQ(told.outcomes[Outcome::holds], static_cast<int>(cases.size())) << told.explanation;
  EXPECT_EQ(told.left_out, 0u);
  // Without the contract there would be no answer.
  WorkerProcess worker(ASSAY_WORKER, plugin("wrapped_builtin"));
  const auto run = worker.run(cases[0], plugin_alone)[0];
  EXPECT_EQ(run.end, RunEnd::refused);
  EXPECT_EQ(run.explanation, "the relation needs a function `count`");
}

// What a plug-in leaves out by itself, and says so, is counted and not held against it.
TEST(Relations, L19_WhatTheContractLeavesOutIsNoMiss) {
  auto cases = counted_cases(150);
  for (auto& c : cases) c.counted.reset();
  for (const std::string kind :
       {"rings=2", "rings=2 features", "rest=0.25", "rest=0.25 features"}) {
    SCOPED_TRACE(kind);
    auto says = runs_told(kind, cases);
    EXPECT_EQ(says.outcomes[Outcome::holds], static_cast<int>(cases.size()));
    EXPECT_GT(says.left_out, 100u);
    EXPECT_GT(says.left_out_misses, 5u);
    auto silent = runs_told(kind + " silent", cases);
    EXPECT_GT(silent.broken[Claim::all_pairs], 20);
    EXPECT_GT(silent.broken[Claim::free_sound], 0);
  }
}

// Of a version without these members they are 0, whatever lies behind the older ones.
TEST(Relations, AnOlderTableLeavesNothingOut) {
  static assay_description description = {};
  description.name = description.version = "old";
  description.claims = ASSAY_CLAIM_TOTAL;
  description.counts = 99;
  description.rings = -1;
  assay_detector_api table = *assay_builtin_detector();
  table.limit = nullptr;
  table.describe = [] { return static_cast<const assay_description*>(&description); };
  table.count = [](assay_handle*, const assay_counted_pairs*) -> std::int32_t { return ASSAY_OK; };
  for (const std::uint32_t version : {1u, 2u}) {
    table.abi_version = version;
    const auto read = read_table(&table);
    ASSERT_TRUE(read);
    EXPECT_EQ(read.value().count, nullptr);
    const auto found = read_description(read.value());
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found.value().contract.rings, 0);
    EXPECT_FALSE(found.value().contract.takes_relations);
  }
  table.abi_version = 3;
  EXPECT_EQ(read_description(table).error().message, "unknown counts 99");
  description.counts = ASSAY_COUNTS_FEATURES;
  EXPECT_EQ(read_description(table).error().message, "its rings are below 0");
  description.rings = 2;
  description.rest_distance = .5;
  const auto contract = read_description(table).value().contract;
  EXPECT_EQ(contract.counts, detector::CountedLevel::features);
  EXPECT_TRUE(contract.takes_relations);
  EXPECT_EQ(phrases_of(contract), (std::vector<std::string>{"features beyond 2 rings",
                                                            "features from 0.5 apart at rest"}));
}

}  // namespace
}  // namespace assay::properties
