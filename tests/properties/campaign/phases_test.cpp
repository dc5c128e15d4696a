// The phases of a campaign: with a limit of time, trials come first. The seed draws the large
// meshes.
#include "properties/campaign/phases/phases.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "corpus/cases/case_file.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/judging/exam.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using Clock = std::chrono::steady_clock;

class Noted : public CampaignObserver {
 public:
  void on_phase(const char* phase) override { phases.emplace_back(phase); }
  void on_trials(const TrialsEnd& end) override {
    trials = end;
    until_trials_ended = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  void on_failures_shrunk(const FailureList& kept) override { failures = kept.list; }

  const Clock::time_point begin = Clock::now();
  double until_trials_ended = 0;
  std::vector<std::string> phases;
  TrialsEnd trials;
  std::vector<FailureRecord> failures;
};

class Phases : public testing::Test {
 protected:
  Noted run(const CampaignRequest& request) const {
    Noted noted;
    auto store = test::open_store(scratch / "store.sqlite", binding_of(request));
    EXPECT_TRUE(run_campaign(request, "", store, noted));
    return noted;
  }
  static CampaignRequest always_free(std::uint64_t cases, double seconds) {
    auto request = test::request_of(cases);
    request.plan.seconds = seconds;
    request.plan.laws_every = 0;
    request.plan.fault_cases = 4;
    request.plan.tetrahedron_seconds = 0.1;
    request.plan.policy.repeated_triangles = 100;
    test::set_plugin(request, test::plugin("always_free"));
    return request;
  }
  const tests::Scratch scratch;
};

TEST_F(Phases, TrialsHaveTheTimeWhileSomeAreMissing) {
  constexpr double seconds = 4;
  const auto noted = run(always_free(10'000'000, seconds));
  EXPECT_FALSE(noted.trials.complete);
  EXPECT_GE(noted.until_trials_ended, 0.85 * seconds);
  EXPECT_EQ(noted.phases, (std::vector<std::string>{"trials", "shrinking"}));
  // There is time to shrink what they showed, a little, where the machine does not stand still.
  const bool stalled = noted.failures.empty() || noted.until_trials_ended > 1.1 * seconds;
  EXPECT_TRUE(stalled || std::any_of(noted.failures.begin(), noted.failures.end(),
                                     [](const FailureRecord& f) { return !f.smallest.empty(); }));
}

TEST_F(Phases, OnceTheTrialsAreDoneEverythingElseIs) {
  const auto noted = run(always_free(2, 60));
  EXPECT_TRUE(noted.trials.complete);
  EXPECT_EQ(noted.phases, (std::vector<std::string>{"trials", "repetitions", "shrinking", "faults",
                                                    "tetrahedron"}));
}

// The six-fold volume that the mesh encloses; positive if its triangles are seen from outside.
double volume_of(const corpus::Case& c) {
  double volume = 0;
  const auto& x = c.frames.front();
  for (const auto& t : c.triangles.rowwise()) {
    const Eigen::RowVector3d a = x.row(t(0)), b = x.row(t(1)), d = x.row(t(2));
    volume += a.dot(b.cross(d));
  }
  return volume;
}

// Else a detector could keep a table of them, be right on these meshes and wrong on all others of
// their size.
TEST(LargeMeshes, AreKnownToNobodyBeforeTheSeed) {
  constexpr std::uint64_t most = 800;
  for (const auto& scene : corpus::scenes()) {
    SCOPED_TRACE(scene.name);
    const auto one = repeated_scene(scene, most, 1, 1), same = repeated_scene(scene, most, 1, 1);
    EXPECT_EQ(one.triangles, same.triangles);
    EXPECT_EQ(one.frames, same.frames);
    std::set<Eigen::Index> sizes[2];  // of the scene as it is, and of its other forms
    std::set<std::string> meshes;
    std::size_t most_components = 0;
    constexpr std::uint64_t seeds = 8;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (int form = 0; form < forms_of_a_scene; ++form) {
        auto c = repeated_scene(scene, most, seed, form);
        sizes[form > 0].insert(c.triangles.rows());
        most_components =
            std::max(most_components,
                     detector::make_topology(c.triangles, c.frames[0].rows()).components.size());
        EXPECT_TRUE(!scene.closed || volume_of(c) > 0) << seed;
        c.frames.resize(1);
        meshes.insert(corpus::case_text(c));
        c.frames.front().setZero();
        meshes.insert(corpus::case_text(c));  // its triangles alone
      }
    }
    EXPECT_EQ(meshes.size(), 2 * seeds * forms_of_a_scene);
    EXPECT_GT(*sizes[0].begin(), 500);
    EXPECT_GT(sizes[1].size(), 4u);
    EXPECT_LE(*sizes[1].begin(), 400);
    EXPECT_GT(most_components, 3u);
  }
}

// An error that a detector makes after a hundred commits of one handle is to show.
TEST(LargeMeshes, TheLongSequenceMeetsItselfUpToItsLastSteps) {
  constexpr std::uint64_t seeds = 24;
  constexpr std::size_t late = 100;
  std::set<std::size_t> lengths;
  std::set<std::string> meshes;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    auto c = long_sequence(seed);
    const auto same = long_sequence(seed);
    SCOPED_TRACE(fmt::format("seed {}, {} triangles", seed, c.triangles.rows()));
    EXPECT_EQ(c.triangles, same.triangles);
    EXPECT_EQ(c.frames, same.frames);
    EXPECT_LE(c.triangles.rows(), 130);
    const std::size_t steps = corpus::steps_of(c).size();
    lengths.insert(steps);
    ASSERT_GE(steps, std::size_t{fewest_long_steps});
    ASSERT_LE(steps, std::size_t{most_long_steps});
    std::vector<std::size_t> last(steps - late);
    std::iota(last.begin(), last.end(), late);
    std::size_t from_a_free_start = 0;
    for (const auto& step : judge_case(with_steps(c, last)))
      from_a_free_start += !step.pairs.empty() && step.first.hi > 0 ? 1 : 0;
    EXPECT_GT(from_a_free_start, 0u);
    c.frames.resize(1);
    c.frames.front().setZero();
    meshes.insert(corpus::case_text(c));  // its triangles alone
  }
  EXPECT_GT(lengths.size(), 10u);
  EXPECT_EQ(meshes.size(), seeds);
}

// The search as a phase: what it stores does not depend on the number of jobs, a run that is killed
// goes on, a share has its part of the lanes, and what is found is shrunk and can be judged again.

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
    return test::open_store(scratch_ / name, binding_of(request));
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
      rows.push_back(failure.id() + failure.signature() + failure.mesh);
    return rows;
  }
  const tests::Scratch scratch_;
};

TEST_F(SearchPhase, JobsAndInterruptionsDoNotChangeWhatIsFound) {
  const auto one = searching(1);
  auto whole = open(one, "whole");
  run(one, whole);
  const auto facts = facts_in(whole);
  ASSERT_EQ(facts.sources.size(), 3u);
  EXPECT_EQ(facts.sources[2].cases, 100u);
  EXPECT_GT(facts.sources[0].defects, 0u);
  EXPECT_GT(facts.sources[0].causes.size(), 5u);
  const auto failures = whole.failures();
  ASSERT_FALSE(failures.empty());
  for (const auto& failure : failures) EXPECT_EQ(failure.source, Source::search) << failure.id();

  const auto two = searching(2);
  auto shared = open(two, "shared");
  run(two, shared, std::chrono::steady_clock::now());  // the time is over: nothing is stored
  EXPECT_TRUE(facts_in(shared).sources.empty());
  run(two, shared);
  EXPECT_EQ(rows_of(shared), rows_of(whole));
  run(two, shared);  // nothing is left to do
  EXPECT_EQ(rows_of(shared), rows_of(whole));
}

TEST_F(SearchPhase, AShareAsksItsPartOfTheCases) {
  const auto request = searching(1, 2);
  auto store = open(request, "share");
  run(request, store);
  const auto lanes = facts_in(store).sources;
  ASSERT_EQ(lanes.size(), 2u);
  EXPECT_EQ(lanes[0].planned, 500u);
  EXPECT_EQ(lanes[1].planned, 50u);
}

// The trials alone hold: the plan has none. A plug-in that calls everything free is found by the
// search, and what is found is shrunk.
TEST_F(SearchPhase, WhatItFindsIsShrunk) {
  auto request = test::request_of(0);
  test::set_plugin(request, test::plugin("always_free"));
  request.plan.strata = {{"closed-generic", 1, 0}};
  request.plan.search = 100;
  auto store = open(request, "store");
  Noted noted;
  const auto ran = run_campaign(request, curated_cases, store, noted);
  ASSERT_TRUE(ran) << ran.error().message;
  EXPECT_NE(std::find(noted.phases.begin(), noted.phases.end(), "search"), noted.phases.end());
  EXPECT_TRUE(std::any_of(noted.failures.begin(), noted.failures.end(), [](const auto& f) {
    return f.source == Source::search && !f.smallest.empty();
  }));
}

}  // namespace
}  // namespace assay::properties
