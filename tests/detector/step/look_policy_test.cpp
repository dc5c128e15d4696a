// When the cost model has a look at views at all: the sample of a large component, what is hoped
// for, and how long a rest is.
#include "detector/step/culling_policy.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

// A sheet of 4,608 triangles, 96 to a row, of which every 72nd is sampled: the first of the sample
// that lies in row r is the one numbered r / 0.75.
constexpr int layered_side = 49;

// Seen from the middle at height 0, a row at height 1 is of one sign, a row at height -1 of the
// other. Between them rows fall from 1 to -1 and have no sign. A row that stays at height 0 is seen
// along itself, which doubles cannot tell from a sign. The last points are always below.
struct LayeredSheet {
  LayeredSheet(int rows_above, int rows_below, bool falls) : x_t0(layered_side * layered_side, 3) {
    for (int i = 0; i < layered_side; ++i) {
      const bool is_above = i <= rows_above, is_below = i >= layered_side - 1 - rows_below;
      for (int j = 0; j < layered_side; ++j)
        x_t0.row(i * layered_side + j) << i, j, is_above ? 1 : is_below ? -1 : falls ? 1 : 0;
    }
    x_t1 = x_t0;
    if (!falls) return;
    x_t1.middleRows((rows_above + 1) * layered_side,
                    (layered_side - 2 - rows_above - rows_below) * layered_side)
        .col(2)
        .setConstant(-1);
  }
  Positions x_t0, x_t1;
};

// Whether a look is worth it where culling bvh has so many pairs. With the sheet lie `small` more
// triangles, each a component of its own: too small for a sample.
bool is_looked_at(const LayeredSheet& sheet, std::uint64_t pairs, int small = 0) {
  const Triangles of_sheet = tests::sheet_triangles(layered_side);
  Triangles t(of_sheet.rows() + small, 3);
  Positions x_t0(sheet.x_t0.rows() + 3 * small, 3), x_t1;
  t.topRows(of_sheet.rows()) = of_sheet;
  x_t0.topRows(sheet.x_t0.rows()) = sheet.x_t0;
  for (int i = 0; i < small; ++i) {
    const auto v = static_cast<int>(sheet.x_t0.rows()) + 3 * i;
    t.row(of_sheet.rows() + i) << v, v + 1, v + 2;
    x_t0.row(v) << 100, 3 * i, 0;
    x_t0.row(v + 1) << 101, 3 * i, 0;
    x_t0.row(v + 2) << 100, 3 * i + 1, 1;
  }
  x_t1 = x_t0;
  x_t1.topRows(sheet.x_t1.rows()) = sheet.x_t1;
  const Surface surface = make_surface(t, x_t0.rows());
  BoundingVolumeTree tree{surface.mesh, x_t0};
  const BoundaryHandler boundary;
  const ElementaryTest elementary;
  const StopFunction stop;
  StepMarks marks;
  const MovingPoint middle = {{24, 24, 0}, {24, 24, 0}};
  marks.primitives.assign(surface.mesh.components.size(), {middle, middle});
  const GivenStep given = {surface, tree, boundary, elementary, stop, {x_t0, x_t1}, nullptr};
  return CostModel(surface, pairs, {}).worth_classifying(given, marks);
}

constexpr std::uint64_t any_number = 1'000'000'000;

// A quarter of the sample of either sign: views leave out two sixteenths of the pairs.
TEST(LookPolicy, AnEighthOfThePairsIsEnough) {
  EXPECT_TRUE(is_looked_at(LayeredSheet(12, 12, true), any_number));
  EXPECT_FALSE(is_looked_at(LayeredSheet(12, 11, true), any_number));
  EXPECT_FALSE(is_looked_at(LayeredSheet(11, 12, true), any_number));
}

// Small components count as if they were all of one sign: 659 of 5,267 triangles are an eighth.
TEST(LookPolicy, SmallComponentsCountWhole) {
  EXPECT_FALSE(is_looked_at(LayeredSheet(0, 0, true), any_number, 658));
  EXPECT_TRUE(is_looked_at(LayeredSheet(0, 0, true), any_number, 659));
}

// Half of the sample is above, so a quarter of the pairs is saved, for a third of their cost. The
// others take integers, which cost as much as 15 candidates each.
TEST(LookPolicy, WhatIntegersCostMustBeHopedFor) {
  const LayeredSheet half(23, 0, false);
  std::uint64_t none = 0, enough = any_number;
  ASSERT_FALSE(is_looked_at(half, none));
  ASSERT_TRUE(is_looked_at(half, enough));
  while (enough - none > 100) {
    const std::uint64_t middle = (none + enough) / 2;
    (is_looked_at(half, middle) ? enough : none) = middle;
  }
  EXPECT_NEAR(static_cast<double>(enough), 15 * (4608. / 2) / (.25 / 3), 200);
}

// Views that have a cost and nothing to save.
PolicyState after_a_loss(PolicyState before) {
  before.overhead = 1;
  const Surface surface = make_surface(tests::octahedron(), 6);
  const Positions x = tests::octahedron_positions(1);
  BoundingVolumeTree tree{surface.mesh, x};
  const BoundaryHandler boundary;
  const ElementaryTest elementary;
  const StopFunction stop;
  PacedStop pace(stop);
  StepMarks marks;
  marks.primitives.resize(1);
  marks.signs.assign(8, ViewSign::positive);
  marks.free = {false};
  CostModel policy(surface, 0, before);
  EXPECT_FALSE(policy.worth_sweeping({surface, tree, boundary, elementary, stop, {x, x}, nullptr},
                                     marks, pace));
  return policy.next({}, true);
}

TEST(LookPolicy, ARestIsOf32StepsAtMost) {
  PolicyState state;
  for (const std::uint64_t expected : {1u, 2u, 4u, 8u, 16u, 32u, 32u}) {
    state = after_a_loss(state);
    EXPECT_EQ(state.pause, expected);
    state.pause = 0;
  }
}

// What views have saved, from the share of pairs that they left out and the pairs that were left.
class Saved : public testing::Test {
 protected:
  Saved() {
    marks.primitives.resize(1);
    marks.signs.assign(8, ViewSign::positive);
    marks.free = {false};
  }
  // Whether views have paid where the first `clean` of eight triangles are clean, K had 1,000
  // candidates and the closure so many more.
  bool has_paid(int clean, std::uint64_t closure, std::uint64_t of_k = 1000) {
    marks.clean.assign(8, 0);
    std::fill_n(marks.clean.begin(), clean, std::uint8_t{1});
    CostModel policy(surface, 0, {});
    policy.worth_using({surface, tree, boundary, elementary, stop, {x, x}, nullptr}, marks, {});
    StepCounts counts;
    counts.search.candidate_pairs = of_k + closure;
    policy.record_cost(counts, of_k);
    return policy.next(counts, true).pause == 0;
  }
  const Surface surface = make_surface(tests::octahedron(), 6);
  const Positions x = tests::octahedron_positions(1);
  BoundingVolumeTree tree{surface.mesh, x};
  const BoundaryHandler boundary;
  const ElementaryTest elementary;
  const StopFunction stop;
  StepMarks marks;
};

// Six of eight are clean, so 36 of 64 pairs were left out. The 1,000 candidates are the other 28,
// and what was left out, 1,285, is worth a third.
TEST_F(Saved, IsReckonedFromThePairsThatAreLeft) {
  EXPECT_TRUE(has_paid(6, 428));
  EXPECT_FALSE(has_paid(6, 429));
}

// Where all pairs were left out their number is not known from those that are left: there are none.
TEST_F(Saved, AllAndNothingIsLeft) {
  EXPECT_TRUE(has_paid(8, 0, 0));
  EXPECT_FALSE(has_paid(8, 1, 0));
}

}  // namespace
}  // namespace assay::detector
