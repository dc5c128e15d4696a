// A lane of the search: it depends on its name alone, fills an archive, and finds what is wrong in
// far fewer cases than the trials need.
#include "properties/search/search.h"

#include <gtest/gtest.h>

#include "tests/properties/search/races.h"

namespace assay::properties {
namespace {

JudgeCases judge_of(const test::Runner& runner) {
  return [&runner](std::span<const corpus::Case> cases) {
    std::vector<SearchedCase> judged;
    for (const auto& c : cases) judged.push_back(test::judged_by(runner, c));
    return judged;
  };
}

SearchSpace space_of(const test::Runner& runner) {
  return {runner.detector.contract,
          case_sources({true, false, ASSAY_SOURCE_DIR "/corpus/curated", {}}),
          [](corpus::Case c) { return c; }};
}

TEST(Search, ALaneDependsOnItsNameAlone) {
  const auto runner = test::runner_of(*find_fault("pair/zero-zero-dropped"));
  const auto space = space_of(runner);
  const auto judge = judge_of(runner);
  const auto one = search({"search/test:1:1", 150}, space, judge, {});
  const auto again = search({"search/test:1:1", 150}, space, judge, {});
  const auto other = search({"search/test:1:2", 150}, space, judge, {});
  ASSERT_TRUE(one.complete);
  EXPECT_EQ(one.cases, 150);
  EXPECT_EQ(one.causes, again.causes);
  EXPECT_NE(one.causes, other.causes);
  ASSERT_EQ(one.found.size(), again.found.size());
  for (std::size_t i = 0; i < one.found.size(); ++i) {
    EXPECT_EQ(corpus::case_text(one.found[i].c), corpus::case_text(again.found[i].c));
    EXPECT_EQ(one.found[i].after, again.found[i].after);
  }
}

TEST(Search, WhatIsFoundFailsAgainFromItsFile) {
  const auto runner = test::runner_of(*find_fault("pair/zero-zero-dropped"));
  const auto result = search({"search/test:2:1", 300}, space_of(runner), judge_of(runner), {});
  ASSERT_FALSE(result.found.empty());
  EXPECT_GE(result.defects, result.found.size());
  for (const auto& found : result.found) {
    const auto read = corpus::parse_case(corpus::case_text(found.c), "found");
    ASSERT_TRUE(read) << read.error().message;
    const auto judged = test::judged_by(runner, read.value());
    ASSERT_TRUE(judged.trials[0].failure);
    EXPECT_EQ(judged.trials[0].failure->signature(), found.failure.signature());
  }
}

TEST(Search, FillsItsArchiveWithCauses) {
  const test::Runner right{
      built_in_detector().in(built_in_detector().configurations[0]),
      [](const corpus::Case& c) { return run_case(c, built_in_detector().configurations[0]); },
      {}};
  const auto result = search({"search/test:3:1", 600}, space_of(right), judge_of(right), {});
  EXPECT_EQ(result.defects, 0);
  EXPECT_GE(result.causes.size(), 30);
  const auto holds = [&](const std::string& word) {
    return std::any_of(result.causes.begin(), result.causes.end(), [&](const std::string& cause) {
      return cause.find(word) != std::string::npos;
    });
  };
  for (const char* word : {"double root", "at the end of a feature", "coplanar throughout",
                           "without area", "t at 1", "t near 0", "t at 0"})
    EXPECT_TRUE(holds(word)) << word;
}

TEST(Search, AStoppedLaneIsNotComplete) {
  const auto runner = test::runner_of(*find_fault("pair/zero-zero-dropped"));
  int asked = 0;
  const auto result = search({"search/test:4:1", 1000}, space_of(runner), judge_of(runner),
                             [&] { return ++asked > 3; });
  EXPECT_FALSE(result.complete);
  EXPECT_LT(result.cases, 100);
}

// In the candidates of the oracle, over some seeds: a case of the search has few triangles.
void expect_less_work(const test::Runner& runner, int seeds, double least_ratio) {
  const test::RaceLimits limits{1500};
  double by_search = 0, at_random = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto found = test::race_by_search(runner, seed, limits);
    EXPECT_TRUE(found.found) << seed;
    by_search += static_cast<double>(found.candidates);
    at_random += static_cast<double>(test::race_at_random(runner, seed, limits).candidates);
  }
  fmt::print("{} candidates by search, {} at random\n", by_search, at_random);
  EXPECT_GE(at_random, least_ratio * by_search);
}

TEST(Search, NeedsLessWorkForAPeer) {
  const auto runner = test::runner_of_peer("cubic_double");
  if (!runner) GTEST_SKIP() << "the peer was not built";
  expect_less_work(*runner, 30, 10);
}

TEST(Search, NeedsFarLessWorkForAFault) {
  expect_less_work(test::runner_of(*find_fault("view/three-samples")), 15, 15);
}

// Trials need some 5,000 cases for each of these.
TEST(Search, FindsWhatRestsOnTheStateAlone) {
  for (const char* name : {"state/released-when-connected", "state/start-layers-not-checked",
                           "state/winding-not-checked"}) {
    const auto runner = test::runner_of(*find_fault(name));
    double cases = 0;
    constexpr int seeds = 8;
    for (int seed = 1; seed <= seeds; ++seed) {
      const auto found = test::race_by_search(runner, seed, {2000});
      EXPECT_TRUE(found.found) << name << " " << seed;
      cases += static_cast<double>(found.cases) / seeds;
    }
    fmt::print("{}: {} cases\n", name, cases);
    EXPECT_LE(cases, 600) << name;
  }
}

}  // namespace
}  // namespace assay::properties
