// Sequences with releases: a passage through a hole and back, a response of the caller, a state
// that is saved and restored.
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::revolved, tests::sides,
    tests::sphere_rings, tests::tip_at;

// view-auto tests so small a mesh without views.
Options with_points() { return {Culling::view_point}; }

// Of the octahedron without its triangle at +x +y +z.
Detector make(const Options& options = with_points(), const Positions& x = octahedron_positions(2),
              const Triangles& triangles = octahedron().bottomRows(7)) {
  return std::move(Detector::create(triangles, x, options).value());
}

void expect_same(const StepResult& a, const StepResult& b) {
  tests::expect_same_work(a, b);
  EXPECT_EQ(a.counts.ghosts.pairs, b.counts.ghosts.pairs);
  EXPECT_EQ(a.counts.ghosts.elementary_tests, b.counts.ghosts.elementary_tests);
  EXPECT_EQ(a.counts.release.pairs, b.counts.release.pairs);
  EXPECT_EQ(a.counts.winding_numbers, b.counts.winding_numbers);
}

TEST(Release, L9_OutThroughTheHoleAndBackIsUndone) {
  const Positions in = octahedron_positions(2), out = tip_at(1.5), near = tip_at(.5);
  Detector detector = make();
  EXPECT_EQ(detector.step(in, in).against_all, 0u);
  const auto passes = detector.step(in, out);
  EXPECT_GT(passes.violated, 0u);
  EXPECT_EQ(passes.dirty, 0u);
  const auto stays = detector.step(out, out);
  EXPECT_GT(stays.dirty, 0u) << "what is through the hole stays in doubt";
  const auto returns = detector.step(out, in);
  EXPECT_GT(returns.violated, 0u);
  EXPECT_GT(returns.dirty, 0u);
  const auto after = detector.step(in, near);
  EXPECT_GT(after.counts.release.in_doubt, 0u) << "not free by view: L9 has to release";
  EXPECT_EQ(after.counts.release.released, after.counts.release.in_doubt);
  EXPECT_EQ(after.violated, 0u);
  EXPECT_EQ(after.dirty, 0u);
  // From then on it costs what a mesh costs that has always been clean.
  Detector clean = make();
  clean.step(in, near);
  expect_same(detector.step(near, in), clean.step(near, in));
}

// Of the pairs that met in the step before, each is looked at once, unless both of its triangles
// are known to be touched.
TEST(Release, L9_LastingContactsAreCounted) {
  const Positions in = octahedron_positions(2);
  Positions through = in;
  through.row(5) << .5, .25, 3;
  Detector detector = make(with_points(), in, octahedron());
  const auto result = detector.step(in, through);
  ASSERT_GT(result.pairs.size(), 2u);
  const auto still = detector.evaluate(through, through);
  std::set<TrianglePair> last;
  for (const auto& contact : still.pairs) last.insert(contact.pair);
  std::uint64_t looked_at = 0;
  std::set<std::int32_t> touched;
  for (const auto& [pair, time, feature] : result.pairs) {
    if (touched.contains(pair.a) && touched.contains(pair.b)) continue;
    ++looked_at;
    if (last.contains(pair)) touched.insert({pair.a, pair.b});
  }
  EXPECT_GT(still.counts.release.in_doubt, 0u);
  EXPECT_EQ(still.counts.release.pairs, looked_at);
}

// A component with two holes: what stays out of either is in doubt, as it is at a new start.
TEST(Release, L9_WhatStaysOutOfOneOfTwoHolesStaysInDoubt) {
  Triangles two_holes(6, 3);
  two_holes << octahedron().middleRows(1, 5), octahedron().bottomRows(1);
  const Positions in = octahedron_positions(2);
  for (const bool through_first : {true, false}) {
    Positions out = in;
    out.row(through_first ? 5 : 4).setConstant(through_first ? 1.5 : -1.5);
    Detector detector = make(with_points(), in, two_holes),
             anew = make(with_points(), in, two_holes);
    EXPECT_GT(detector.step(in, out).violated, 0u);
    const auto stays = detector.step(out, out), expected = anew.step(out, out);
    EXPECT_GT(expected.dirty, 0u) << through_first;
    EXPECT_GE(stays.dirty, expected.dirty) << through_first;
  }
}

TEST(Release, L8_TheCallerAnswersACollision) {
  const Positions in = octahedron_positions(2);
  Positions hit = in;
  hit.row(1) << 3, .5, -1;
  Detector detector = make();
  const auto tried = detector.evaluate(in, hit);
  ASSERT_EQ(tried.answer, Answer::collision);
  const Positions shortened = in + .5 * tried.first.lo * (hit - in);
  ASSERT_EQ(detector.evaluate(in, shortened).answer, Answer::free);
  ASSERT_FALSE(detector.commit());
  EXPECT_EQ(detector.commit()->error, InputError::nothing_to_commit) << "once is enough";
  const auto next = detector.step(shortened, in);
  EXPECT_EQ(next.answer, Answer::free);
  EXPECT_EQ(next.dirty, 0u) << "what was only tried leaves no doubt";
  Detector anew = make();
  const auto elsewhere = detector.step(shortened, shortened);
  EXPECT_EQ(elsewhere.doubts, anew.step(shortened, shortened).doubts)
      << "a start that differs from the committed end is a new one";
}

TEST(SavedState, RestoredGivesTheSameBits) {
  const Positions in = octahedron_positions(2), out = tip_at(1.5);
  Detector detector = make();
  detector.step(in, out);
  const SavedState saved = detector.state();
  SavedState copy = saved;
  // Made from other positions: rules of apexes and views are in the state.
  Detector other = make(with_points(), tip_at(.25));
  ASSERT_FALSE(other.restore(copy));
  Detector same = make();
  ASSERT_FALSE(same.restore(copy));
  const Positions* from = &out;
  for (const auto* x : {&out, &in, &in}) {
    const auto expected = detector.step(*from, *x);
    EXPECT_EQ(other.evaluate(*from, *x).doubts, expected.doubts);
    EXPECT_EQ(other.step(*from, *x).signs, expected.signs);
    expect_same(same.step(*from, *x), expected);
    from = x;
  }
  ASSERT_FALSE(detector.restore(saved));
  EXPECT_GT(detector.step(out, in).dirty, 0u) << "back at the saved state";
}

// After a step that looked for the first pairs alone not all contacts are known. What is restored
// must still say so, or triangles that pierce each other would be taken for clean.
TEST(SavedState, L6L9_FirstPairsAreNotAllOnceRestoredEither) {
  const Positions in = tests::sphere(2);
  Positions pierced = in;
  pierced.row(sides * sphere_rings) << 0, 0, 4;
  pierced.row(sides * (sphere_rings / 2)) << -2.25, 0, 0;  // elsewhere, and later
  const Options options{.culling = Culling::view_point, .pairs = Pairs::first};
  Detector detector = make(options, in, revolved(sphere_rings)),
           other = make(options, in, revolved(sphere_rings));
  ASSERT_EQ(detector.step(in, pierced).answer, Answer::collision);
  ASSERT_FALSE(other.restore(detector.state()));
  const auto expected = detector.evaluate(pierced, pierced);
  const auto again = other.evaluate(pierced, pierced);
  EXPECT_EQ(again.dirty, expected.dirty);
  expect_same(again, expected);
}

// Apexes that this detector chose by itself have no part in a state from elsewhere.
TEST(SavedState, RestoredIsTheWholeState) {
  const Positions x = octahedron_positions(2);
  Detector detector = make();
  detector.step(x, tip_at(.25));
  const SavedState saved = detector.state();
  // With its tip on the centroid of the hole a ghost fan stands elsewhere.
  Detector other = make(with_points(), tip_at(2. / 3));
  ASSERT_NE(other.state().fields().apex_rules[0].height, saved.fields().apex_rules[0].height);
  ASSERT_FALSE(other.restore(saved));
  EXPECT_EQ(other.state(), saved);
}

TEST(SavedState, OfAnotherMeshOrCullingIsRefused) {
  const Positions x = octahedron_positions(2);
  Detector closed = make(with_points(), x, octahedron());
  Detector open = make();
  open.step(x, tip_at(1.5));
  const auto problem = open.restore(closed.state());
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->error, InputError::foreign_state);
  EXPECT_GT(open.step(tip_at(1.5), x).dirty, 0u) << "nothing has changed";
  Positions more(7, 3);  // a vertex that no triangle has
  more << x, 0, 0, 0;
  Detector one_more = make(with_points(), more);
  ASSERT_TRUE(one_more.restore(open.state()));
  EXPECT_EQ(make({Culling::view_line}).restore(open.state())->error, InputError::foreign_state);
  EXPECT_FALSE(open.restore(make().state()));
  EXPECT_EQ(open.step(tip_at(.25), x).dirty, 0u) << "the state of one that has not begun";
}

}  // namespace
}  // namespace assay::detector
