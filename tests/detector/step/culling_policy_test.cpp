// The decisions of the cost model, one by one, each from the counts on which it rests.
#include "detector/step/culling_policy.h"

#include "detector/detector.h"
#include "detector/traditional/traditional.h"
#include "tests/detector/step/bare_step.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::BareStep, tests::octahedron, tests::octahedron_positions, tests::revolved,
    tests::sphere, tests::sphere_rings;

// Two octahedra without their first triangles, all seen positive: views save every pair.
struct TwoOpen : BareStep {
  TwoOpen() : BareStep(triangles(), positions(), positions(), 12) {}
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
  StepMarks marks_with(bool first_is_free, bool second_is_free) const {
    StepMarks all;
    all.primitives.resize(2);
    all.signs.assign(surface.all().triangles.size(), ViewSign::positive);
    all.free = {first_is_free, second_is_free};
    return all;
  }
};

// The fewest pairs of culling bvh at which the views of a step are used.
std::uint64_t least_pairs(bool first_is_free, bool second_is_free, double overhead = 0) {
  TwoOpen mesh;
  PolicyState before;
  before.overhead = overhead;
  const StepMarks marks = mesh.marks_with(first_is_free, second_is_free);
  for (std::uint64_t pairs = 0; pairs < 10'000; ++pairs) {
    if (CostModel(mesh.surface, pairs, before).worth_sweeping(mesh.step, marks, mesh.cost.pace))
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
  StepMarks marks = mesh.marks_with(true, false);
  marks.clean.assign(mesh.surface.mesh.triangles.size(), 0);
  CostModel policy(mesh.surface, 1'000'000, {});
  ASSERT_TRUE(policy.worth_sweeping(mesh.step, marks, mesh.cost.pace));
  EXPECT_FALSE(policy.worth_using(mesh.step, marks, {}));
  EXPECT_EQ(policy.use(), ViewUse::start_unknown);
  EXPECT_EQ(policy.next({}, 0, true).pause, 0u);
  const StepState state;
  mesh.step.last_state = &state;
  CostModel later_policy(mesh.surface, 1'000'000, {});
  ASSERT_TRUE(later_policy.worth_sweeping(mesh.step, marks, mesh.cost.pace));
  EXPECT_FALSE(later_policy.worth_using(mesh.step, marks, {}));
  EXPECT_EQ(later_policy.use(), ViewUse::among_dirty);
  EXPECT_EQ(later_policy.next({}, 0, true).pause, 1u);
  marks.clean.assign(mesh.surface.mesh.triangles.size(), 1);
  EXPECT_TRUE(later_policy.worth_using(mesh.step, marks, {}));
}

// A pair left out saves a third of its cost.
// Of the signs of all triangles enough would be saved. But what was in contact counts as dirty.
TEST(ViewPolicy, WhereTooMuchWasInContactReleaseIsNotTried) {
  TwoOpen mesh;
  StepState state;
  mesh.step.last_state = &state;
  const StepMarks marks = mesh.marks_with(false, false);
  for (const auto& [in_contact, is_swept] :
       {std::pair(0, true), {2, true}, {8, true}, {12, false}, {14, false}}) {
    state.contacts.clear();
    for (std::int32_t t = 0; t < in_contact; t += 2) state.contacts.push_back({t, t + 1});
    CostModel policy(mesh.surface, 1'000'000, {});
    EXPECT_EQ(policy.worth_sweeping(mesh.step, marks, mesh.cost.pace), is_swept) << in_contact;
    EXPECT_EQ(policy.use(), is_swept ? ViewUse::used : ViewUse::among_dirty);
  }
}

TEST(ViewPolicy, WhatViewsHaveCostMustBeSavedByTheSigns) {
  EXPECT_EQ(least_pairs(true, true, 100), 300u);
  EXPECT_EQ(least_pairs(true, true, 1000), 3000u);
}

TEST(ViewPolicy, WhatViewsHaveCostAndRestsAreForgottenByHalves) {
  const TwoOpen mesh;
  PolicyState state;
  state.next_pause = 32, state.overhead = 64;
  for (const std::uint64_t expected : {16u, 8u, 4u, 2u, 1u, 1u}) {
    const double overhead = state.overhead / 2;
    state = CostModel(mesh.surface, 100, state).next({}, 0, true);  // after a look that paid
    EXPECT_EQ(state.overhead, overhead);
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
  EXPECT_EQ(policy.next(counts, 0, true).candidates, 500u) << "nothing was searched";
  counts.search.candidate_pairs = 300;
  EXPECT_EQ(policy.next(counts, 0, true).candidates, 300u);
  ASSERT_TRUE(policy.worth_proving({1, 1, 1}, 1, 0));
  EXPECT_EQ(policy.next(counts, 0, true).candidates, 500u) << "proofs have left out some";
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
  policy.anchors({}, mesh.x_t0, pace);
  return policy.next({}, 0, true).least_anchor_age;
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
  int calls = 0;
  const StopFunction stop = [&] { return ++calls, false; };
  PacedStop pace(stop, work_of_each);
  CostModel(mesh.surface, 100, state).anchors({}, mesh.x_t0, pace);
  EXPECT_GE(calls, 2) << "once for each component";
}

// When the cost model has a look at views at all: the sample of a large component, what is hoped
// for, and how long a rest is.

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
  BareStep bare(t, x_t0, x_t1, x_t0.rows());
  const MovingPoint middle = tests::still({24, 24, 0});
  bare.marks.primitives.assign(bare.surface.mesh.components.size(), {middle, middle});
  return CostModel(bare.surface, pairs, {}).worth_classifying(bare.step, bare.marks);
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

// An octahedron at rest, seen positive.
struct SeenPositive : BareStep {
  SeenPositive() : BareStep(octahedron(), octahedron_positions(1)) {
    marks.primitives.resize(1);
    marks.signs.assign(8, ViewSign::positive);
    marks.free = {false};
  }
};

// Views that have a cost and nothing to save.
PolicyState after_a_loss(PolicyState before) {
  before.overhead = 1;
  SeenPositive mesh;
  CostModel policy(mesh.surface, 0, before);
  EXPECT_FALSE(policy.worth_sweeping(mesh.step, mesh.marks, mesh.cost.pace));
  return policy.next({}, 0, true);
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
class Saved : public testing::Test, protected SeenPositive {
 protected:
  // Whether views have paid where the first `clean` of eight triangles are clean, K had 1,000
  // candidates and the closure so many more.
  bool has_paid(int clean, std::uint64_t closure, std::uint64_t of_k = 1000) {
    marks.clean.assign(8, 0);
    std::fill_n(marks.clean.begin(), clean, std::uint8_t{1});
    CostModel policy(surface, 0, {});
    policy.worth_using(step, marks, {});
    StepCounts counts;
    counts.search.candidate_pairs = of_k + closure;
    policy.record_cost(counts, of_k);
    return policy.next(counts, 0, true).pause == 0;
  }
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

// What culling auto may lose to culling bvh.
class Account : public testing::Test, protected SeenPositive {
 protected:
  CostModel saver(const PolicyState& before, const StepState* last_state = nullptr) {
    CostModel policy(surface, 1000, before, true);
    policy.begin(step.motion, last_state, true);
    return policy;
  }
};

TEST_F(Account, ViewsOfASmallMeshAreMadeAtOnce) {
  CostModel policy = saver({});
  ASSERT_TRUE(policy.is_due());
  EXPECT_EQ(policy.most_for_views(), 8'000) << "0.04 ms";
  policy.pay_for_views(true, 5'000);
  EXPECT_TRUE(policy.is_due());
  EXPECT_TRUE(policy.next({}, 0, true).has_views);
}

TEST_F(Account, ViewsThatWereTooDearWaitUntilTwiceAsMuchIsEarned) {
  CostModel policy = saver({});
  policy.pay_for_views(false, 0);
  EXPECT_FALSE(policy.is_due());
  EXPECT_EQ(policy.use(), ViewUse::saving_up);
  PolicyState state = policy.next({}, 0, true);
  EXPECT_EQ(state.credit, 0);
  EXPECT_EQ(state.tried, 8'000);
  EXPECT_EQ(state.pause, 0u);
  state.credit = 15'999;
  EXPECT_FALSE(saver(state).is_due());
  state.credit = 16'000;
  EXPECT_TRUE(saver(state).is_due());
}

StepCounts searched(std::uint64_t candidates, std::uint64_t tests) {
  StepCounts counts;
  counts.search.candidate_pairs = candidates;
  counts.narrow.elementary_tests = tests;
  return counts;
}

TEST_F(Account, AStepWithoutViewsEarnsAShareOfWhatItTakes) {
  PolicyState before;
  before.credit = -1;
  EXPECT_NEAR(saver(before).next(searched(10, 1), 2, true).credit,
              -1 + .05 * (4.4 * 10 + 48 + 2 * 155), 1e-9);
}

// The tree of a restored detector is another one, and its steps have to decide alike.
TEST_F(Account, WhatDependsOnTheTreeEarnsNothing) {
  PolicyState before;
  before.credit = -1;
  StepCounts counts = searched(10, 1);
  CostModel proves = saver(before);
  ASSERT_TRUE(proves.worth_proving({1, 1, 1}, 1, 0));
  EXPECT_EQ(proves.next(counts, 0, true).credit, -1);
  CostModel rests = saver(before);
  rests.begin(step.motion.at_start(), nullptr, true);
  EXPECT_EQ(rests.next(counts, 0, true).credit, -1);
  const double earned = saver(before).next(counts, 0, true).credit;
  counts.search.box_tests = counts.ghosts.box_tests = 1000;
  EXPECT_EQ(saver(before).next(counts, 0, true).credit, earned);
}

// Every pair is left out, and bvh would have had a thousand.
TEST_F(Account, AFreeStepEarnsWhatItSavesAndPaysForItsViews) {
  CostModel policy = saver({});
  policy.pay_for_views(true, 5'000);
  ASSERT_TRUE(policy.worth_classifying(step, marks));
  StepCounts counts;
  counts.free_components = 1;
  EXPECT_DOUBLE_EQ(policy.next(counts, 0, true).credit, 8'000 - 5'000 + 1.05 * 4.4 * 1000 - 2 * 8);
}

// Views leave 100 of a thousand pairs, and a release; a first contact says nothing of what is left.
TEST_F(Account, ASearchWithViewsEarnsWhatItSaves) {
  StepCounts counts = searched(100, 1);
  CostModel policy = saver({});
  policy.record_cost(counts, 100);
  counts.release.in_doubt = 2;
  EXPECT_DOUBLE_EQ(policy.next(counts, 0, true).credit,
                   8'000 + 1.05 * (4.4 * 1000 + 48) - (5 * 8 + 22 * 100 + 48) - 20 * 2);
  EXPECT_EQ(saver({}).next({}, 0, true).credit, 8'000);
}

// To verify the start anew would cost more than views save.
TEST_F(Account, AStartOfWhichAFirstContactIsKnownIsNotVerified) {
  StepState last_state;
  last_state.contacts_are_complete = false;
  PolicyState state;
  state.has_views = true;
  EXPECT_FALSE(saver(state, &last_state).is_due());
  last_state.contacts_are_complete = true;
  EXPECT_TRUE(saver(state, &last_state).is_due());
}

// Culling auto proves patches apart (L14) where counts say that it pays, and nowhere else.

// Each vertex of a sheet somewhere else: neighbours face all ways.
Positions crumpled(Positions x) {
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    for (int k = 0; k < 3; ++k)
      x(v, k) += std::fmod(41.3 * (double(v) + 1) * (double(v) + 7 * k), 2.);
  return x;
}

StepResult step(const Triangles& triangles, const Positions& x_t0, const Positions& x_t1,
                Culling culling = Culling::automatic, Start start = Start::clean,
                Arithmetic arithmetic = Arithmetic::exact) {
  return Detector::create(triangles, x_t0, {culling, start, Pairs::all, arithmetic})
      .value()
      .step(x_t0, x_t1);
}

// In exact arithmetic the fans of vertices prove all neighbours apart but those at the rim, for
// less than the proof of a patch costs. In bounded arithmetic there are no fans.
TEST(ProofsPolicy, L14_AFlatSheetIsProvedFreeAtOnceWhereFansAreNotProved) {
  const Positions x = tests::flat_squares(30), lifted = x.rowwise() + Eigen::RowVector3d(0, 0, 1);
  const auto proved = step(tests::squares(30, 30), x, lifted, Culling::automatic, Start::clean,
                           Arithmetic::bounded);
  EXPECT_EQ(proved.counts.search.contour_tests, 1u);
  EXPECT_EQ(proved.counts.search.candidate_pairs, 0u);
  const auto result = step(tests::squares(30, 30), x, lifted);
  EXPECT_EQ(result.counts.search.contour_tests, 0u);
  EXPECT_EQ(result.answer, Answer::free);
}

TEST(ProofsPolicy, L14_ACrumpledSheetIsNotAskedForProofs) {
  const Triangles sheet = tests::squares(30, 30);
  const Positions x = crumpled(tests::flat_squares(30)),
                  moved = x.rowwise() + Eigen::RowVector3d(0, 0, 1);
  const auto result = step(sheet, x, moved, Culling::automatic, Start::unknown),
             bvh = step(sheet, x, moved, Culling::bvh, Start::unknown);
  EXPECT_EQ(result.counts.search.contour_tests, 0u);
  EXPECT_EQ(result.counts.search.candidate_pairs, bvh.counts.search.candidate_pairs);
  tests::expect_same_contacts(result, bvh);
}

// Sheets, which are proved apart at rest, are of the regions of the tree: another has other ones.
TEST(ProofsPolicy, WhatSheetsLeaveOutDoesNotShowInTheStepsToCome) {
  const Triangles sheet = tests::squares(50, 50);
  const Positions flat = tests::flat_squares(50);
  Positions wound = flat;
  for (Eigen::Index v = 0; v < flat.rows(); ++v) {
    const double turn = 0.2 * flat(v, 0);
    wound.row(v) << (5 + turn) * std::cos(turn), flat(v, 1), (5 + turn) * std::sin(turn);
  }
  Detector one = Detector::create(sheet, wound, {Culling::automatic, Start::unknown}).value(),
           other = Detector::create(sheet, crumpled(flat), {Culling::automatic, Start::unknown})
                       .value();
  const StepResult here = one.step(wound, wound), there = other.step(wound, wound);
  EXPECT_NE(here.counts.search.candidate_pairs, there.counts.search.candidate_pairs);
  const PolicyState a = one.state().fields().committed->policy,
                    b = other.state().fields().committed->policy;
  EXPECT_EQ(a.candidates, b.candidates);
  EXPECT_EQ(a.credit, b.credit);
}

TEST(ProofsPolicy, WhereAllComponentsAreFreeNothingIsProved) {
  Triangles one = revolved(sphere_rings), two(2 * one.rows(), 3);
  const Positions x = sphere(1);
  two << one, one.array() + static_cast<std::int32_t>(x.rows());
  const Positions near = tests::side_by_side(x, x, 4), far = tests::side_by_side(x, x, 5);
  Detector detector = Detector::create(two, far, {Culling::automatic, Start::clean}).value();
  StepResult result;
  for (int i = 0; i < 100 && result.views != ViewUse::used; ++i)  // until views are earned
    result = detector.step(i % 2 == 0 ? far : near, i % 2 == 0 ? near : far);
  EXPECT_EQ(result.counts.free_components, 2u);
  EXPECT_EQ(result.counts.search.contour_tests, 0u);
}

// Two triangles are neighbours in one place at most: their proof would leave out one candidate.
TEST(ProofsPolicy, PatchesOfFewerThanFourTrianglesAreNotAskedFor) {
  Triangles strip(2, 3);
  strip << 0, 1, 2, 1, 3, 2;
  Positions x(4, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  const NormalConeSearch all, few(NormalConeSearch::Scope::of_four_triangles_or_more);
  const Topology mesh = make_topology(strip, 4);
  BoundingVolumeTree tree(mesh, x);
  const Marks marks(tree);
  const PairTables tables = EveryPair().candidates();
  const SteppedMesh motion = {x, x};
  for (const auto* search : {&all, &few}) {
    PacedStop never(never_stops);
    const auto of_mesh = search->prepare(mesh, tree, never);
    of_mesh->fit(tree, mesh, motion, never);
    SearchCounts counts;
    of_mesh->search({mesh, tree, marks, tables, &never}, counts,
                    [](std::int32_t, std::int32_t) { return true; });
    EXPECT_EQ(counts.contour_tests, search == &all ? 1u : 0u);
    EXPECT_EQ(counts.candidate_pairs, search == &all ? 0u : 1u);
  }
}

TEST(ProofsPolicy, WhatIsHopedForIsHeldAgainstTheCostOfCones) {
  const Surface surface = make_surface(tests::squares(10, 10), 11 * 11);
  const std::uint64_t adjacent = adjacent_pairs(surface.mesh);
  const std::size_t triangles = surface.mesh.triangles.size();
  CostModel policy(surface, adjacent, {});
  EXPECT_TRUE(policy.worth_proving({1, 1, 1}, 1, triangles));
  EXPECT_TRUE(policy.worth_proving({1, 1, .75}, 1, triangles));
  EXPECT_FALSE(policy.worth_proving({1, .75, .5}, 1, triangles))
      << "proofs for small ones cost more";
  EXPECT_FALSE(policy.worth_proving({1, 1, 0}, 1, triangles)) << "no large patch is free";
  EXPECT_FALSE(policy.worth_proving({.4, 1, 1}, 1, triangles)) << "few patches are free";
  EXPECT_FALSE(policy.worth_proving({.7, 0, 0}, 1, triangles)) << "only small patches are free";
  EXPECT_FALSE(policy.worth_proving({1, 1, 1}, .05, triangles)) << "few neighbours are asked for";
  EXPECT_FALSE(policy.worth_proving({1, 1, 1}, 1, 2 * adjacent))
      << "cones cost more than they save";
}

}  // namespace
}  // namespace assay::detector
