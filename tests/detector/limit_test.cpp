// Detector::limit: how far a step may be taken (L17).
#include "detector/boxes/moving_box.h"
#include "detector/detector.h"
#include "tests/close_passes.h"
#include "tests/test.h"

namespace assay::tests {
namespace {

using namespace detector;

const Triangles two = triangles({{0, 1, 2}, {3, 4, 5}});

// A triangle at rest, and one above it with a corner at z; its other corners are at 4.
Positions corner_at(double z) {
  return positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {2, 1, 4}, {1, 2, 4}});
}

Detector make(const Options& options = {}) {
  return Detector::create(two, corner_at(3), options).value();
}

TEST(DetectorLimit, L17_AFreeStepIsTakenWhole) {
  auto detector = make();
  const auto limit = detector.limit(corner_at(3), corner_at(0.1));
  EXPECT_EQ(limit.answer, Answer::free);
  EXPECT_EQ(limit.share, 1);
  EXPECT_EQ(limit.positions, corner_at(0.1));
}

TEST(DetectorLimit, L17_BeforeAContactItStops) {
  for (const auto culling : all_values<Culling>) {
    auto detector = make({culling});
    const auto limit = detector.limit(corner_at(3), corner_at(-1));
    EXPECT_EQ(limit.answer, Answer::collision);
    EXPECT_EQ(limit.first, (TimeEnclosure{0.75, 0.75}));
    EXPECT_GE(limit.share, 0.9 * 0.75);
    EXPECT_LT(limit.share, 0.75);
    EXPECT_EQ(limit.positions, corner_at(3 - 4 * limit.share));
    EXPECT_EQ(detector.step(corner_at(3), limit.positions).answer, Answer::free);
  }
}

TEST(DetectorLimit, L17_CommitGoesToWhereItStops) {
  auto detector = make();
  const auto limit = detector.limit(corner_at(3), corner_at(-1));
  ASSERT_FALSE(detector.commit());
  // What continues there needs no verified start.
  EXPECT_EQ(detector.step(limit.positions, corner_at(3)).counts.winding_numbers, 0u);
  // A limit that is not committed leaves the state.
  const auto before = detector.state();
  detector.limit(corner_at(3), corner_at(-1));
  EXPECT_EQ(detector.state(), before);
}

TEST(DetectorLimit, L17_AMeshInContactStays) {
  auto detector = make();
  for (const double z : {0., -1.}) {
    const auto limit = detector.limit(corner_at(z), corner_at(3));
    EXPECT_EQ(limit.answer, Answer::collision);
    EXPECT_EQ(limit.share, 0);
    EXPECT_FALSE(limit.is_short) << "farther places are no matter of rounding";
    EXPECT_EQ(limit.positions, corner_at(z));
    EXPECT_TRUE(detector.commit()) << "there is nothing to commit";
  }
}

TEST(DetectorLimit, L17_WhereNoNumberLiesBetweenItStays) {
  const double least = std::numeric_limits<double>::denorm_min();
  auto detector = make();
  const auto limit = detector.limit(corner_at(least), corner_at(-1));
  EXPECT_EQ(limit.share, 0);
  EXPECT_TRUE(limit.is_short);
  EXPECT_EQ(limit.positions, corner_at(least));
  // Two units above it, one is left to go.
  const auto next = detector.limit(corner_at(2 * least), corner_at(-2 * least));
  EXPECT_EQ(next.positions, corner_at(least));
  EXPECT_LT(next.share, 0.5);
}

TEST(DetectorLimit, L17_GreatestNumbersDoNotOverflow) {
  const double most = std::numeric_limits<double>::max();
  const auto sheet = [&](double z) {
    return positions(
        {{0, 0, 0}, {most, 0, 0}, {0, most, 0}, {1, 1, z}, {2, 1, most}, {1, 2, most}});
  };
  auto detector = make({Culling::bvh});
  const auto limit = detector.limit(sheet(most), sheet(-most));
  EXPECT_EQ(limit.first, (TimeEnclosure{0.5, 0.5}));
  EXPECT_GE(limit.share, 0.45);
  EXPECT_TRUE(limit.positions.allFinite());
  EXPECT_EQ(detector.evaluate(sheet(most), limit.positions).answer, Answer::free);
}

TEST(DetectorLimit, L16_L17_WithASeparationItKeepsIt) {
  auto detector = make({.culling = Culling::bvh, .separation = 1});
  EXPECT_EQ(detector.limit(corner_at(3), corner_at(1.5)).share, 1);
  const auto limit = detector.limit(corner_at(3), corner_at(-1));
  EXPECT_EQ(limit.first, (TimeEnclosure{0.5, 0.5}));
  EXPECT_GE(limit.share, 0.45);
  EXPECT_GT(limit.positions(3, 2), 1);
  EXPECT_EQ(detector.limit(corner_at(0.5), corner_at(3)).share, 0) << "it starts too near";
}

TEST(DetectorLimit, L17_WhatProvesNothingIsRefused) {
  for (const auto arithmetic : {Arithmetic::double_precision, Arithmetic::single_precision}) {
    auto detector = make({.arithmetic = arithmetic});
    const auto limit = detector.limit(corner_at(3), corner_at(1));
    EXPECT_EQ(limit.answer, Answer::error);
    ASSERT_TRUE(limit.problem);
    EXPECT_EQ(limit.problem->error, InputError::proves_nothing);
    EXPECT_EQ(limit.share, 0);
  }
  auto bounded = make({.arithmetic = Arithmetic::bounded});
  EXPECT_GE(bounded.limit(corner_at(3), corner_at(-1)).share, 0.9 * 0.75);
}

TEST(DetectorLimit, BadFramesAndStopsLeadNowhere) {
  auto detector = make();
  const auto refused = detector.limit(corner_at(3), corner_at(3).topRows(5));
  EXPECT_EQ(refused.answer, Answer::error);
  EXPECT_EQ(refused.problem->error, InputError::wrong_frame_size);
  const auto stopped = detector.limit(corner_at(3), corner_at(-1), [] { return true; });
  EXPECT_EQ(stopped.answer, Answer::undecided);
  EXPECT_EQ(stopped.share, 0);
  EXPECT_TRUE(detector.commit());
}

// The largest free share of 1,000 equal ones up to 0.95 of the time.
double farthest_free(Detector& detector, const ClosePass& pass, double time) {
  constexpr int shares = 1000;
  for (int k = shares; k > 0; --k) {
    const double share = 0.95 * time * k / shares;
    Positions x = pass.x_t0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x.data()[i] = place_between(pass.x_t0.data()[i], pass.x_t1.data()[i], share);
    if (detector.first_contact(pass.x_t0, x).answer == Answer::free) return share;
  }
  return 0;
}

struct Gone {
  double share = 0;  // of the time until the contact
  bool is_far = false, is_short = false;
};
Gone go(const ClosePass& pass) {
  auto detector = Detector::create(pass.triangles, pass.x_t0, {.culling = Culling::bvh}).value();
  const auto limit = detector.limit(pass.x_t0, pass.x_t1);
  EXPECT_EQ(limit.answer, Answer::collision) << pass.name;
  const double short_below = 0.98 * 0.95 * limit.first.lo;
  EXPECT_EQ(limit.is_short, limit.first.hi > 0 && limit.share < short_below) << pass.name;
  EXPECT_EQ(detector.commit().has_value(), limit.share == 0) << pass.name;
  if (limit.share > 0) {
    const auto there = detector.step(limit.positions, limit.positions);
    EXPECT_EQ(there.counts.winding_numbers, 0u) << "what is committed is not where it stops";
  }
  EXPECT_EQ(detector.step(pass.x_t0, limit.positions).answer,
            limit.first.hi == 0 ? Answer::collision : Answer::free);
  const double farthest = farthest_free(detector, pass, limit.first.lo);
  return {limit.share / limit.first.lo, limit.share >= 0.98 * farthest, limit.is_short};
}

TEST(DetectorLimit, L17_WhereSomethingIsPassedCloselyItGoesNearlyAsFarAsItCan) {
  const auto passes = known_close_passes();
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const auto gone = go(passes[i]);
    // Along the sliver the free places lie apart.
    EXPECT_TRUE(gone.is_far || (i == 0 && gone.share > 0.7)) << passes[i].name;
    EXPECT_TRUE(gone.is_short) << passes[i].name;
  }
  std::size_t tried_again = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto gone = go(drawn_close_pass(seed));
    EXPECT_TRUE(gone.is_far) << seed;
    tried_again += gone.share < 0.949 ? 1 : 0;
  }
  EXPECT_GT(tried_again, 20u);
}

// A line search in ten lines that cannot tunnel.
TEST(DetectorLimit, L17_ALineSearchCannotTunnel) {
  auto detector = make();
  Positions x = corner_at(3);
  const Positions goal = corner_at(-5);
  const auto energy = [&](const Positions& at) { return (at - goal).squaredNorm(); };
  for (int round = 0; round < 60; ++round) {
    const auto limit = detector.limit(x, goal);
    if (limit.share == 0 || energy(limit.positions) >= energy(x)) break;
    ASSERT_FALSE(detector.commit());
    x = limit.positions;
  }
  EXPECT_GT(x(3, 2), 0);
  EXPECT_LT(x(3, 2), 1e-10);
}

}  // namespace
}  // namespace assay::tests
