// The detector's handling of holes against the oracle's own: loops, touched triangles, clean
// triangles at a new start. Small-integer steps, where degenerate ghosts and ties are frequent.
#include "corpus/cases/case_file.h"
#include "detector/boundary/boundary_handler.h"
#include "detector/detector.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "oracle/view/touched_by_ghosts.h"
#include "properties/worlds/small_steps.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Positions;

detector::Triangles ghosts_of(const detector::Surface& surface) {
  const auto& all = surface.all().triangles;
  const std::size_t own = surface.mesh.triangles.size();
  detector::Triangles ghosts(static_cast<Eigen::Index>(all.size() - own), 3);
  for (std::size_t g = own; g < all.size(); ++g) {
    ghosts.row(static_cast<Eigen::Index>(g - own)) << all[g][0], all[g][1], all[g][2];
  }
  return ghosts;
}

Positions rows(const std::vector<detector::MovingPoint>& apexes, bool at_end) {
  return detector::with_apexes(Positions(0, 3), apexes, at_end);
}

struct Tally {
  std::uint64_t unclosed = 0, violated = 0, dirty = 0, all_positive = 0;
};

// The oracle's touched set, ghosts of a component against that component only (L10).
std::vector<std::uint8_t> touched_of_own(const detector::Surface& surface, const Positions& x_t0,
                                         const Positions& x_t1,
                                         const detector::Triangles& triangles,
                                         const detector::StepResult& result, bool at_start) {
  std::vector<std::uint8_t> touched(surface.mesh.triangles.size(), 0);
  const Positions apexes_t0 = rows(result.apexes, false), apexes_t1 = rows(result.apexes, true);
  const detector::Triangles ghosts = ghosts_of(surface);
  for (const auto& component : surface.all().components) {
    detector::Triangles own(0, 3), own_ghosts(0, 3);
    std::vector<std::int32_t> index;
    for (const auto t : component.triangles) {
      const bool is_ghost = t >= triangles.rows();
      auto& list = is_ghost ? own_ghosts : own;
      list.conservativeResize(list.rows() + 1, 3);
      list.bottomRows(1) = is_ghost ? ghosts.row(t - triangles.rows()) : triangles.row(t);
      if (!is_ghost) index.push_back(t);
    }
    const auto part = oracle::touched_by_ghosts({x_t0, x_t1}, own, apexes_t0, apexes_t1, own_ghosts,
                                                {1, at_start});
    for (std::size_t i = 0; i < part.size(); ++i) {
      touched[static_cast<std::size_t>(index[i])] = part[i];
    }
  }
  return touched;
}

void check(const SmallStep& step, Tally& tally) {
  auto made = detector::Detector::create(
      step.triangles, step.x_t0,
      {detector::Culling::view_point, detector::Start::verified, detector::Pairs::all});
  ASSERT_TRUE(made);
  const detector::Surface& surface = made.value().surface();
  std::vector<oracle::Loop> loops = oracle::boundary_loops(step.triangles);
  ASSERT_EQ(surface.loops, loops);
  if (loops.empty()) return;
  ++tally.unclosed;
  const detector::Triangles ghosts = ghosts_of(surface);
  ASSERT_TRUE(oracle::closes(step.triangles, ghosts));
  const auto result = made.value().step(step.x_t0, step.x_t1);
  if (result.counts.free_components == surface.mesh.components.size()) {
    ++tally.all_positive;
    return;  // no ghost touches anything, by L5: the laws of the campaign check that
  }
  const auto touched = touched_of_own(surface, step.x_t0, step.x_t1, step.triangles, result, true);
  const oracle::Instant start(oracle::with_apexes(step.x_t0, rows(result.apexes, false)));
  const auto layers = oracle::layers_at(start, step.triangles, ghosts);
  for (std::size_t t = 0; t < touched.size(); ++t) {
    const bool violated = result.doubts[t] & detector::doubt::violated;
    const bool dirty = result.doubts[t] & detector::doubt::dirty;
    ASSERT_EQ(violated, touched[t] != 0) << "triangle " << t;
    ASSERT_EQ(dirty, layers.clean[t] == 0) << "triangle " << t;
    tally.violated += violated;
    tally.dirty += dirty;
  }
}

TEST(Boundary, L9_L11_SetsEqualTheOraclesOnUnclosedMeshes) {
  constexpr std::uint64_t seed = 20113, cases = 20000;
  Tally tally;
  for (std::uint64_t i = 0; i < cases && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    check(make_small_step(seed, i), tally);
  }
  std::printf(
      "%llu unclosed of %llu cases, seed %llu: %llu violated, %llu dirty, %llu all positive\n",
      static_cast<unsigned long long>(tally.unclosed), static_cast<unsigned long long>(cases),
      static_cast<unsigned long long>(seed), static_cast<unsigned long long>(tally.violated),
      static_cast<unsigned long long>(tally.dirty),
      static_cast<unsigned long long>(tally.all_positive));
  EXPECT_GT(tally.unclosed, cases / 5);
  EXPECT_GT(tally.violated, cases / 20);
}

// D8: the tip enters through the hole (step A, no contact) and hits from inside (step B).
TEST(Boundary, L8_L11_D8_TheArmIsViolatedThenDirtyThenFound) {
  const auto c = tests::curated_case("D8_release_arm_sequence");
  const auto& frames = c.frames;
  auto made = detector::Detector::create(
      c.triangles, frames[0],
      {detector::Culling::view_point, detector::Start::verified, detector::Pairs::all});
  const auto a = made.value().step(frames[0], frames[1]);
  EXPECT_EQ(a.answer, detector::Answer::free);
  EXPECT_GT(a.violated, 0u);
  EXPECT_EQ(a.dirty, 0u);
  const auto b = made.value().step(frames[1], frames[2]);
  EXPECT_EQ(b.answer, detector::Answer::collision);
  EXPECT_GE(b.dirty, a.violated);
}

}  // namespace
}  // namespace assay::properties
