// The decisions of view-auto, one by one, from the counts that they rest on.
#include "detector/step/culling_policy.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions;

// Two octahedra without their first triangles, all seen positive: views save every pair.
struct TwoOpen {
  static Triangles triangles() {
    Triangles t(14, 3);
    t << octahedron().bottomRows(7), octahedron().bottomRows(7).array() + 6;
    return t;
  }
  static Positions positions() {
    Positions x(14, 3);
    x << octahedron_positions(1), octahedron_positions(1).rowwise() + Eigen::RowVector3d(10, 0, 0),
        1. / 3, 1. / 3, 1. / 3, 10 + 1. / 3, 1. / 3, 1. / 3;  // two apexes
    return x;
  }
  GivenStep given(const StepState* known = nullptr) {
    return {surface, tree, boundary, elementary, stop, {x, x}, known};
  }
  StepMarks marks(bool first_is_free, bool second_is_free) const {
    StepMarks marks;
    marks.primitives.resize(2);
    marks.signs.assign(surface.all().triangles.size(), ViewSign::positive);
    marks.free = {first_is_free, second_is_free};
    return marks;
  }
  Positions x = positions();
  Surface surface = make_surface(triangles(), 12);
  BoundingVolumeTree tree{surface.mesh, x.topRows(12)};
  BoundaryHandler boundary;
  ElementaryTest elementary;
  StopFunction stop;
  PacedStop pace{stop};
};

// The fewest pairs of culling bvh at which the views of a step are used.
std::uint64_t least_pairs(bool first_is_free, bool second_is_free, double overhead = 0) {
  TwoOpen mesh;
  PolicyState before;
  before.overhead = overhead;
  const GivenStep given = mesh.given();
  const StepMarks marks = mesh.marks(first_is_free, second_is_free);
  for (std::uint64_t pairs = 0; pairs < 10'000; ++pairs) {
    if (CostModel(mesh.surface, pairs, before).worth_sweeping(given, marks, mesh.pace))
      return pairs;
  }
  return 10'000;
}

TEST(ViewPolicy, GhostsOfFreeComponentsAreNoWork) {
  const auto none = least_pairs(false, false), first = least_pairs(true, false),
             second = least_pairs(false, true);
  EXPECT_GT(first, 0u);
  EXPECT_EQ(first, second);
  EXPECT_EQ(none, first + second) << "a ghost's box and a triangle: 9 pairs each";
  EXPECT_EQ(least_pairs(true, true), 0u);
}

// Where nothing was known of the start, that too much is dirty says nothing against views.
TEST(ViewPolicy, L15_DirtyAtAnUnknownStartTheNextStepIsLookedAt) {
  TwoOpen mesh;
  StepMarks marks = mesh.marks(true, false);
  marks.clean.assign(mesh.surface.mesh.triangles.size(), 0);
  CostModel policy(mesh.surface, 1'000'000, {});
  ASSERT_TRUE(policy.worth_sweeping(mesh.given(), marks, mesh.pace));
  EXPECT_FALSE(policy.worth_using(mesh.given(), marks, {}));
  EXPECT_EQ(policy.use(), ViewUse::start_unknown);
  EXPECT_EQ(policy.next({}, true).pause, 0u);
  const StepState state;
  const GivenStep given = mesh.given(&state);
  CostModel known(mesh.surface, 1'000'000, {});
  ASSERT_TRUE(known.worth_sweeping(given, marks, mesh.pace));
  EXPECT_FALSE(known.worth_using(given, marks, {}));
  EXPECT_EQ(known.use(), ViewUse::among_dirty);
  EXPECT_EQ(known.next({}, true).pause, 1u);
  marks.clean.assign(mesh.surface.mesh.triangles.size(), 1);
  EXPECT_TRUE(known.worth_using(given, marks, {}));
}

// A pair left out saves a third of its cost.
// Of the signs of all triangles enough would be saved. But what was in contact counts as dirty.
TEST(ViewPolicy, WhereTooMuchWasInContactReleaseIsNotTried) {
  TwoOpen mesh;
  StepState state;
  const GivenStep given = mesh.given(&state);
  const StepMarks marks = mesh.marks(false, false);
  for (const auto& [in_contact, is_swept] :
       {std::pair(0, true), {2, true}, {8, true}, {12, false}, {14, false}}) {
    state.met.clear();
    for (std::int32_t t = 0; t < in_contact; t += 2) state.met.push_back({t, t + 1});
    CostModel policy(mesh.surface, 1'000'000, {});
    EXPECT_EQ(policy.worth_sweeping(given, marks, mesh.pace), is_swept) << in_contact;
    EXPECT_EQ(policy.use(), is_swept ? ViewUse::used : ViewUse::among_dirty);
  }
}

TEST(ViewPolicy, WhatViewsHaveCostMustBeSavedByTheSigns) {
  EXPECT_EQ(least_pairs(true, true, 100), 300u);
  EXPECT_EQ(least_pairs(true, true, 1000), 3000u);
}

// After a look that paid.
PolicyState after_views_paid(const PolicyState& before) {
  const TwoOpen mesh;
  return CostModel(mesh.surface, 100, before).next({}, true);
}

TEST(ViewPolicy, WhatViewsHaveCostIsForgottenByHalves) {
  PolicyState state;
  state.overhead = 64;
  for (const double expected : {32., 16., 8.}) {
    state = after_views_paid(state);
    EXPECT_EQ(state.overhead, expected);
  }
}

TEST(ViewPolicy, RestsAreForgottenByHalves) {
  PolicyState state;
  state.next_pause = 32;
  for (const std::uint64_t expected : {16u, 8u, 4u, 2u, 1u, 1u}) {
    state = after_views_paid(state);
    EXPECT_EQ(state.next_pause, expected);
    EXPECT_EQ(state.pause, 0u);
  }
}

TEST(ViewPolicy, CandidatesAreThoseOfTheLastSearchThatProvedNothing) {
  const TwoOpen mesh;
  PolicyState before;
  before.candidates = 500;
  CostModel policy(mesh.surface, 500, before);
  StepCounts counts;
  EXPECT_EQ(policy.next(counts, true).candidates, 500u) << "nothing was searched";
  counts.search.candidate_pairs = 300;
  EXPECT_EQ(policy.next(counts, true).candidates, 300u);
  ASSERT_TRUE(policy.worth_proving({1, 1, 1}, 1, 0));
  EXPECT_EQ(policy.next(counts, true).candidates, 500u) << "proofs have left out some";
}

// least_anchor_age after a step that chose anchors again.
std::uint64_t kept_for(std::uint64_t before, double replaced_at) {
  const TwoOpen mesh;
  PolicyState state;
  state.anchors_are_due = true;
  state.least_anchor_age = before;
  state.replaced_at = replaced_at;
  CostModel policy(mesh.surface, 100, state);
  PacedStop pace(never_stops);
  policy.anchors({}, mesh.x, pace);
  return policy.next({}, true).least_anchor_age;
}

TEST(ViewPolicy, AnchorsThatAreNoBetterAreKeptTwiceAsLong) {
  EXPECT_EQ(kept_for(16, 1), 32u);
  EXPECT_EQ(kept_for(1024, 1), 2048u);
  EXPECT_EQ(kept_for(4096, 1), 4096u);
  EXPECT_EQ(kept_for(1024, .5), 16u) << "better ones may soon be better still";
}

TEST(ViewPolicy, ChoosingAnchorsIsWorkThatCanBeStopped) {
  const TwoOpen mesh;
  PolicyState state;
  state.anchors_are_due = true;
  constexpr std::uint64_t work_of_each = 400;
  int asked = 0;
  const StopFunction stop = [&] { return ++asked, false; };
  PacedStop pace(stop, work_of_each);
  CostModel(mesh.surface, 100, state).anchors({}, mesh.x, pace);
  EXPECT_GE(asked, 2) << "once for each component";
}

}  // namespace
}  // namespace assay::detector
