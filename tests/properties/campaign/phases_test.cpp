// What a campaign does with a limit of time: trials first. And its large meshes are drawn by the
// seed.
#include "properties/campaign/phases/phases.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "corpus/cases/case_file.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/repetitions.h"
#include "properties/judging/judged_run.h"
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
  void on_failures_shrunk(const KeptFailures& kept) override { failures = kept.list; }

  const Clock::time_point begin = Clock::now();
  double until_trials_ended = 0;
  std::vector<std::string> phases;
  TrialsEnd trials;
  std::vector<StoredFailure> failures;
};

class Phases : public testing::Test {
 protected:
  Noted run(const CampaignRequest& request) const {
    Noted noted;
    auto store = Store::open(scratch / "store.sqlite", binding_of(request));
    EXPECT_TRUE(store);
    const auto ran = run_campaign(request, "", store.value(), noted);
    EXPECT_TRUE(ran);
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
  EXPECT_EQ(noted.phases, (std::vector<std::string>{"trials", "shrinking", "slow cases"}));
  // There is time to shrink what they showed, a little, where the machine does not stand still.
  const bool stalled = noted.failures.empty() || noted.until_trials_ended > 1.1 * seconds;
  EXPECT_TRUE(stalled || std::any_of(noted.failures.begin(), noted.failures.end(),
                                     [](const StoredFailure& f) { return !f.smallest.empty(); }));
}

TEST_F(Phases, OnceTheTrialsAreDoneEverythingElseIs) {
  const auto noted = run(always_free(2, 60));
  EXPECT_TRUE(noted.trials.complete);
  EXPECT_EQ(noted.phases, (std::vector<std::string>{"trials", "repetitions", "shrinking",
                                                    "slow cases", "faults", "tetrahedron"}));
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
    std::set<Eigen::Index> sizes;
    std::set<std::string> meshes;
    std::size_t most_components = 0;
    constexpr std::uint64_t seeds = 8;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (int form = 0; form < forms_of_a_scene; ++form) {
        auto c = repeated_scene(scene, most, seed, form);
        if (form == 0) {
          EXPECT_GT(c.triangles.rows(), 500);
        } else {
          sizes.insert(c.triangles.rows());
        }
        most_components =
            std::max(most_components,
                     detector::make_topology(c.triangles, c.frames[0].rows()).components.size());
        if (scene.closed) {
          EXPECT_GT(volume_of(c), 0) << seed;
        }
        c.frames.resize(1);
        meshes.insert(corpus::case_text(c));
        c.frames.front().setZero();
        meshes.insert(corpus::case_text(c));  // its triangles alone
      }
    }
    EXPECT_EQ(meshes.size(), 2 * seeds * forms_of_a_scene);
    EXPECT_GT(sizes.size(), 4u);
    EXPECT_LE(*sizes.begin(), 400);
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
    std::size_t colliding = 0, from_a_free_start = 0;
    for (const auto& step : judge_case(with_steps(c, last))) {
      if (step.pairs.empty()) continue;
      ++colliding;
      from_a_free_start += step.first.hi > 0 ? 1 : 0;
    }
    EXPECT_GT(colliding, 0u);
    EXPECT_GT(from_a_free_start, 0u);
    c.frames.resize(1);
    c.frames.front().setZero();
    meshes.insert(corpus::case_text(c));  // its triangles alone
  }
  EXPECT_GT(lengths.size(), 10u);
  EXPECT_EQ(meshes.size(), seeds);
}

}  // namespace
}  // namespace assay::properties
