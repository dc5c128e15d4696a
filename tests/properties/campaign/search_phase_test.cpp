// The search as a phase: what it stores does not depend on the number of jobs, a run that is killed
// goes on, a share has its part of the lanes, and what is found is shrunk and can be judged again.
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/phases.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

constexpr const char* curated_cases = ASSAY_SOURCE_DIR "/corpus/curated";

// Two lanes of 500 cases and one of 100, on a fault that many cases show.
CampaignRequest searching(int jobs, std::uint64_t shares = 1) {
  auto request = test::faulty("pair/zero-zero-dropped", 8);
  request.detector.configurations.pop_back();
  request.plan.search = 1100;
  request.jobs = jobs;
  request.shares = shares;
  return request;
}

class SearchPhase : public testing::Test {
 protected:
  Store open(const CampaignRequest& request, const std::string& name) const {
    auto store = Store::open(scratch_ / name, binding_of(request));
    EXPECT_TRUE(store) << store.error().message;
    return std::move(store.value());
  }
  static void run(const CampaignRequest& request, Store& store,
                  RunDeadline deadline = test::in_ten_minutes()) {
    search_share(request, curated_cases, store, deadline, {});
  }
  // Everything that was stored of the search, with its hashes.
  static std::vector<std::string> rows_of(const Store& store) {
    std::vector<std::string> rows;
    for (const auto& row : store.evidence()) rows.push_back(row.key + row.fields);
    for (const auto& failure : store.failures())
      rows.push_back(failure.id + failure.signature + failure.mesh);
    return rows;
  }
  const tests::Scratch scratch_;
};

TEST_F(SearchPhase, JobsAndInterruptionsDoNotChangeWhatIsFound) {
  const auto one = searching(1);
  auto whole = open(one, "whole");
  run(one, whole);
  const auto facts = facts_in(whole);
  ASSERT_EQ(facts.search.size(), 3u);
  EXPECT_EQ(facts.search[2].cases, 100u);
  EXPECT_GT(facts.search[0].defects, 0u);
  EXPECT_GT(facts.search[0].causes.size(), 5u);
  const auto failures = whole.failures();
  ASSERT_FALSE(failures.empty());
  for (const auto& failure : failures) EXPECT_TRUE(is_of_search(failure)) << failure.id;

  const auto two = searching(2);
  auto shared = open(two, "shared");
  run(two, shared, std::chrono::steady_clock::now());  // the time is over: nothing is stored
  EXPECT_TRUE(facts_in(shared).search.empty());
  run(two, shared);
  EXPECT_EQ(rows_of(shared), rows_of(whole));
  run(two, shared);  // nothing is left to do
  EXPECT_EQ(rows_of(shared), rows_of(whole));
}

TEST_F(SearchPhase, AShareAsksItsPartOfTheCases) {
  const auto request = searching(1, 2);
  auto store = open(request, "share");
  run(request, store);
  const auto lanes = facts_in(store).search;
  ASSERT_EQ(lanes.size(), 2u);
  EXPECT_EQ(lanes[0].planned, 500u);
  EXPECT_EQ(lanes[1].planned, 50u);
}

class NotedSearch : public CampaignObserver {
 public:
  void on_phase(const char* phase) override { phases.emplace_back(phase); }
  void on_failures_shrunk(const KeptFailures& kept) override { failures = kept.list; }
  std::vector<std::string> phases;
  std::vector<StoredFailure> failures;
};

// The trials alone hold: the plan has none. A plug-in that calls everything free is found by the
// search, and what is found is shrunk.
TEST_F(SearchPhase, WhatItFindsIsShrunk) {
  auto request = test::request_of(0);
  test::set_plugin(request, test::plugin("always_free"));
  request.plan.strata = {{"closed-generic", 1, 0}};
  request.plan.search = 100;
  auto store = open(request, "store");
  NotedSearch noted;
  const auto ran = run_campaign(request, curated_cases, store, noted);
  ASSERT_TRUE(ran) << ran.error().message;
  EXPECT_NE(std::find(noted.phases.begin(), noted.phases.end(), "search"), noted.phases.end());
  const auto found = std::find_if(noted.failures.begin(), noted.failures.end(), is_of_search);
  ASSERT_NE(found, noted.failures.end());
  const auto shrunk = std::any_of(noted.failures.begin(), noted.failures.end(), [](const auto& f) {
    return is_of_search(f) && !f.smallest.empty();
  });
  EXPECT_TRUE(shrunk);
}

}  // namespace
}  // namespace assay::properties
