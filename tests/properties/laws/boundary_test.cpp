// The detector's handling of holes compared with the oracle's: loops, touched triangles, and clean
// triangles at a new start. The steps have small integers, so that degenerate ghosts and ties are
// frequent. Also sequences of such meshes, and view signs.
#include <fmt/format.h>

#include "corpus/cases/case_file.h"
#include "detector/boundary/boundary_handler.h"
#include "detector/detector.h"
#include "detector/view/view_signs.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/random.h"
#include "properties/worlds/small_steps.h"
#include "tests/curated_cases.h"
#include "tests/detector/small_stack.h"
#include "tests/detector/view/triangle_batches.h"
#include "tests/meshes.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties {
namespace {

using namespace detector;
using test::JudgedCase, tests::BatchFamily;

detector::Triangles ghosts_of(const detector::Surface& surface) {
  const std::span all(surface.all().triangles);
  return tests::matrix_of<detector::Triangles>(all.subspan(surface.mesh.triangles.size()));
}

Positions rows(const std::vector<detector::MovingPoint>& apexes, bool at_end) {
  return detector::with_apexes(Positions(0, 3), apexes, at_end);
}

struct Tally {
  std::uint64_t unclosed = 0, violated = 0, dirty = 0, all_positive = 0;
};

// The oracle's touched set, ghosts of a component against that component only (L10).
std::vector<std::uint8_t> touched_of_own(const detector::Surface& surface, const SmallStep& step,
                                         const detector::StepResult& result) {
  const auto& triangles = step.triangles;
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
    const auto part = oracle::touched_by_ghosts({step.x_t0, step.x_t1}, own, apexes_t0, apexes_t1,
                                                own_ghosts, true);
    for (std::size_t i = 0; i < part.size(); ++i)
      touched[static_cast<std::size_t>(index[i])] = part[i];
  }
  return touched;
}

void check(const SmallStep& step, Tally& tally) {
  auto made = detector::Detector::create(step.triangles, step.x_t0, {Culling::view_point});
  ASSERT_TRUE(made);
  const detector::Surface& surface = made.value().surface();
  const auto loops = oracle::boundary_loops(step.triangles);
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
  const auto touched = touched_of_own(surface, step, result);
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
  fmt::print("{} unclosed of {} cases, seed {}: {} violated, {} dirty, {} all positive\n",
             tally.unclosed, cases, seed, tally.violated, tally.dirty, tally.all_positive);
  EXPECT_GT(tally.unclosed, cases / 5);
  EXPECT_GT(tally.violated, cases / 20);
}

// D8: the tip enters through the hole (step A, no contact) and hits from inside (step B).
TEST(Boundary, L8_L11_D8_TheArmIsViolatedThenDirtyThenFound) {
  const auto c = tests::curated_case("D8_release_arm_sequence");
  const auto& frames = c.frames;
  auto made = detector::Detector::create(c.triangles, frames[0], {Culling::view_point});
  const auto a = made.value().step(frames[0], frames[1]);
  EXPECT_EQ(a.answer, detector::Answer::free);
  EXPECT_GT(a.violated, 0u);
  EXPECT_EQ(a.dirty, 0u);
  const auto b = made.value().step(frames[1], frames[2]);
  EXPECT_EQ(b.answer, detector::Answer::collision);
  EXPECT_GE(b.dirty, a.violated);
}

// The detector's view signs, lanes and all, against the oracle's, for triangles without a mesh.

int batches_of(BatchFamily family, bool line) {
  using enum BatchFamily;
  if (family == tiny || family == huge) return 1;
  const bool is_cheap = family == generic || family == small_motion || family == far;
  return is_cheap ? (line ? 20 : 100) : (line ? 5 : 20);
}

void compare(bool line) {
  tests::BatchMaker maker(line ? 20116 : 20115);
  for (std::size_t f = 0; f < tests::batch_family_names.size(); ++f) {
    const auto family = static_cast<BatchFamily>(f);
    std::size_t count = 0;
    std::uint64_t lanes = 0;
    for (int b = 0; b < batches_of(family, line); ++b) {
      const auto batch = maker.make(family, 100, line);
      std::vector<ViewSign> found(batch.mesh.triangles.size());
      ViewCounts counts;
      tests::on_small_stack([&] {
        classify(batch.mesh, batch.mesh.components[0], {batch.x_t0, batch.x_t1}, batch.primitive,
                 found, counts);
      });
      const auto triangles = tests::matrix_of<Triangles>(batch.mesh.triangles);
      ASSERT_EQ(found, oracle::view_signs({batch.x_t0, batch.x_t1}, triangles,
                                          std::span(&batch.primitive, 1)))
          << tests::batch_family_names[f] << ", batch " << b;
      count += found.size();
      lanes += counts.lanes;
    }
    std::printf("%-16s %5zu triangles equal, %.3f of them settled in lanes\n",
                tests::batch_family_names[f], count,
                static_cast<double>(lanes) / static_cast<double>(count));
  }
}

TEST(ViewSigns, L2_PointSignsAreTheOracles) { compare(false); }
TEST(ViewSigns, L1_LineSignsAreTheOracles) { compare(true); }

// Random sequences of unclosed meshes, in and out and about: in every step the violated and the
// dirty triangles are those of the oracle's own account, from its loops, ghosts and layers.

// A walk among three frames of one mesh, often back to where it came from; a step is now and then
// only evaluated, or starts elsewhere.
corpus::Case make_sequence(std::uint64_t seed, std::uint64_t index) {
  const SmallStep step = make_small_step(seed, index);
  Random random(seed, index + (std::uint64_t{1} << 40));
  corpus::Case c;
  c.id = "sequence:" + std::to_string(seed) + ":" + std::to_string(index);
  c.triangles = step.triangles;
  c.frames = {step.x_t0, step.x_t1, step.x_t0};
  for (Eigen::Index v = 0; v < step.x_t0.rows(); ++v)
    if (random.one_in(2)) c.frames[2].row(v) = step.x_t1.row(v);
  std::int32_t at = random.below(3);
  const int steps = random.between(3, 6);
  for (int s = 0; s < steps; ++s) {
    const std::int32_t to = random.below(3);
    const bool commit = !random.one_in(6);
    c.script.push_back({at, to, commit});
    if (commit || random.one_in(8)) at = to;
  }
  return c;
}

struct SequenceTally {
  std::uint64_t steps = 0, violated = 0, dirty = 0, in_doubt = 0, released = 0, windings = 0;
};

void check(const corpus::Case& c, const Options& options, SequenceTally& tally) {
  test::Setting setting;
  setting.options = options;
  const JudgedCase judged(c, setting);
  CaseFacts facts = judged.facts();
  ASSERT_EQ(facts.surface().loops, oracle::boundary_loops(c.triangles));
  ASSERT_TRUE(oracle::closes(c.triangles, facts.ghosts()));
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    ASSERT_TRUE(has_account(facts, s));
    const auto account = account_of_dirty(facts, s);
    const auto& result = facts.result(s);
    for (std::size_t t = 0; t < account.size(); ++t) {
      const bool violated = (result.doubts[t] & doubt::violated) != 0;
      const bool dirty = (result.doubts[t] & doubt::dirty) != 0;
      ASSERT_EQ(violated, facts.touched(s)[t] != 0) << "step " << s << ", triangle " << t;
      ASSERT_EQ(dirty, account[t] != 0) << "step " << s << ", triangle " << t;
      tally.violated += violated;
      tally.dirty += dirty;
    }
    ++tally.steps;
    tally.in_doubt += result.counts.release.in_doubt;
    tally.released += result.counts.release.released;
    tally.windings += result.counts.release.winding_numbers;
  }
}

void check_many(const detector::Options& options, std::uint64_t seed, std::uint64_t wanted) {
  SequenceTally tally;
  std::uint64_t unclosed = 0;
  for (std::uint64_t i = 0; unclosed < wanted && !testing::Test::HasFatalFailure(); ++i) {
    const auto c = make_sequence(seed, i);
    if (oracle::boundary_loops(c.triangles).empty()) continue;
    ++unclosed;
    SCOPED_TRACE(c.id);
    check(c, options, tally);
  }
  fmt::print(
      "{} unclosed sequences, seed {}, {} steps: {} violated, {} dirty; in doubt {}, released {}, "
      "{} "
      "winding numbers of pieces\n",
      unclosed, seed, tally.steps, tally.violated, tally.dirty, tally.in_doubt, tally.released,
      tally.windings);
  EXPECT_GT(tally.violated, unclosed);
  EXPECT_GT(tally.dirty, unclosed);
  EXPECT_GT(tally.released, unclosed / 4);
  EXPECT_GT(tally.windings, unclosed / 4);
}

TEST(Release, L8_L9_L11_SequencesEqualTheOraclesAccount) {
  check_many({Culling::view_point}, 20117, 1500);
}
TEST(Release, L9_WithFirstPairsOnly) {
  check_many({Culling::view_line, Start::verified, Pairs::first}, 20118, 750);
}
TEST(Release, L9_FromAnUnknownStart) {
  check_many({Culling::view_point, Start::unknown}, 20119, 750);
}

}  // namespace
}  // namespace assay::properties
