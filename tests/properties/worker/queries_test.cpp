// A library of one elementary query: every claim has a fault that breaks it, every member of the
// contract one that it excuses, and what it sends in place of answers is a crash or an error.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "properties/judging/trial.h"
#include "properties/queries/query_families.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using test::plugin;

struct FoundInQueries {
  std::map<Outcome, int> outcomes;
  std::map<std::string, int> kinds;
  std::string explanation;  // of the first defect
  std::uint64_t left_out = 0, contacts = 0;
};

// Queries of every family through the plug-in query_alone with these words, each twice.
FoundInQueries queries_with(const std::string& words, std::uint64_t queries_a_family = 25) {
  ::setenv("ASSAY_QUERY", words.c_str(), 1);
  WorkerProcess worker(ASSAY_WORKER, plugin("query_alone"), {.seconds = 20});
  FoundInQueries found;
  const auto description = worker.describe();
  if (!description) {
    ADD_FAILURE() << words << ": " << description.error().message;
    return found;
  }
  DetectorUnderTest detector;
  detector.built_in = false;
  detector.claims = detector.query_claims = claims_on_queries(description.value());
  detector.contract = description.value().contract;
  detector.configurations = {{"plug-in", {}}};
  std::vector<corpus::Case> cases;
  std::vector<CaseRun> runs, again;
  for (const auto& family : query_families()) {
    for (std::uint64_t i = 0; i < queries_a_family; ++i) {
      const auto made =
          make_case(family, "queries:1:" + std::string(family.name) + ":" + std::to_string(i));
      auto seen = contracted(made.c, detector.contract);
      found.left_out += seen ? 0 : 1;
      if (!seen) continue;
      runs.push_back(worker.run(*seen, detector.configurations).front());
      cases.push_back(std::move(*seen));
    }
  }
  for (const auto& c : cases) again.push_back(worker.run(c, detector.configurations).front());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto truth = judge_case(cases[i], detector.contract);
    found.contacts += truth[0].pairs.size();
    const auto verdict =
        judge_trial(cases[i], truth, runs[i], detector.configurations[0], detector, &again[i]);
    ++found.outcomes[verdict.outcome];
    if (!verdict.failure) continue;
    ++found.kinds[std::string(name_of(verdict.failure->claim)) + ": " + verdict.failure->kind];
    if (found.explanation.empty())
      found.explanation = verdict.failure->signature() + "; " + verdict.failure->explanation;
  }
  return found;
}

void expect_query_holds(const std::string& words) {
  auto found = queries_with(words);
  EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.explanation;
  EXPECT_GT(found.outcomes[Outcome::holds], 80) << words;
  EXPECT_GT(found.contacts, 20u) << words;
}

void expect_query_breaks(const std::string& words, const std::string& kind) {
  auto found = queries_with(words);
  EXPECT_GT(found.kinds[kind], 0) << words << ": " << found.explanation;
  EXPECT_GT(found.outcomes[Outcome::defect], 0) << words;
}

TEST(Queries, RightAnswersHold) {
  expect_query_holds("");
  EXPECT_EQ(queries_with("").left_out, 0u);
}

TEST(Queries, EveryClaimHasAFaultThatBreaksIt) {
  expect_query_breaks("miss-inside", "free-sound: answered free");
  expect_query_breaks("miss-at-start", "free-sound: answered free");
  expect_query_breaks("miss-coplanar", "free-sound: answered free");
  expect_query_breaks("late=1e-6", "not-late: late");
  expect_query_breaks("early=1e-6", "first-time: early");
  expect_query_breaks("alarm", "no-spurious: answered collision");
  expect_query_breaks("changing", "deterministic: two runs differ");
  expect_query_breaks("error", "total: error");
  expect_query_breaks("refuse", "total: error");
}

TEST(Queries, WhatIsNoAnswerBreaksTotal) {
  for (const char* words : {"no-interval", "nan", "no-answer"})
    expect_query_breaks(words, "total: error");
}

TEST(Queries, ACrashIsThatOfItsQueryAlone) {
  auto found = queries_with("abort-at-start", 10);
  EXPECT_GT(found.kinds["total: crashed"], 0);
  EXPECT_EQ(found.outcomes[Outcome::defect], found.kinds["total: crashed"]) << found.explanation;
  EXPECT_GT(found.outcomes[Outcome::holds], 20);
}

TEST(Queries, UndecidedAnswersAreNoDefects) {
  for (const char* words : {"undecided", "no-memory"}) {
    auto found = queries_with(words);
    EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.explanation;
    EXPECT_EQ(found.outcomes[Outcome::undecided], static_cast<int>(found.contacts)) << words;
  }
}

TEST(Queries, TheContractLeavesOutWhatItSays) {
  for (const char* words : {"features=vertex-face miss=edge-edge abort-outside",
                            "start=free miss-at-start abort-outside",
                            "features=edge-edge miss=vertex-face abort-outside",
                            "start=apart:1e-9 miss-at-start", "range=1e-6:1e6 abort-outside"}) {
    expect_query_holds(words);
    EXPECT_GT(queries_with(words).left_out, 0u) << words;
  }
  expect_query_holds("float32 abort-outside");
  expect_query_holds("tolerance=1e-4 late=1e-6");
  expect_query_holds("margin=0.1 alarm");
}

TEST(Queries, WhatTheContractDoesNotExcuseIsFound) {
  expect_query_breaks("features=vertex-face miss=vertex-face", "free-sound: answered free");
  expect_query_breaks("start=free miss-inside", "free-sound: answered free");
  expect_query_breaks("start=apart:1e-9 miss-inside", "free-sound: answered free");
  expect_query_breaks("tolerance=1e-4 late=2e-4", "not-late: late");
  expect_query_breaks("range=1e-6:1e6 miss-inside", "free-sound: answered free");
}

TEST(Queries, OfACaseAreThoseThatItWasMadeOf) {
  for (const auto& family : query_families()) {
    for (std::uint64_t i = 0; i < 20; ++i) {
      const auto made = make_case(family, std::string(family.name) + std::to_string(i));
      const auto query = query_of(made.c);
      ASSERT_TRUE(query) << family.name;
      EXPECT_EQ(corpus::case_text(case_of_query(*query, made.c.id)), corpus::case_text(made.c));
    }
  }
  auto c = make_case(query_families()[0], "any").c;
  c.triangles(1, 2) = 0;
  EXPECT_TRUE(says_query(c));
  EXPECT_FALSE(query_of(c));
  EXPECT_FALSE(contracted(c, {}));
}

}  // namespace
}  // namespace assay::properties
