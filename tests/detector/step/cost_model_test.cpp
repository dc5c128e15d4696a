// Culling::view_auto: the primitives from which it sees, and the steps that it does without views.
// This choice changes the cost alone.
#include "detector/detector.h"
#include "detector/step/culling_policy.h"
#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::expect_same_contacts, tests::octahedron, tests::octahedron_positions,
    tests::pushed_octahedron, tests::revolved, tests::sides, tests::sphere, tests::sphere_rings,
    tests::tube_rings, tests::wavy_tube;

Detector make(const Triangles& t, const Positions& x, Culling culling = Culling::view_auto,
              Start start = Start::clean) {
  auto result = Detector::create(t, x, {culling, start});
  EXPECT_TRUE(result.has_value());
  return std::move(result.value());
}

bool has_no_views(const StepResult& r) {
  return r.signs.empty() && r.primitives.empty() && r.doubts.empty() && r.apexes.empty() &&
         r.view_positive + r.view_negative + r.view_zero + r.against_all + r.violated + r.dirty ==
             0;
}
bool was_looked_at(const StepResult& r) {
  return r.counts.view.lanes + r.counts.view.filter + r.counts.view.exact > 0;
}

void expect_same_bytes(const StepResult& a, const StepResult& b) {
  tests::expect_same_work(a, b);
  EXPECT_EQ(a.counts.view.lanes, b.counts.view.lanes);
  ASSERT_EQ(a.primitives.size(), b.primitives.size());
  for (std::size_t c = 0; c < a.primitives.size(); ++c) {
    EXPECT_EQ(a.primitives[c].q0.t0, b.primitives[c].q0.t0);
    EXPECT_EQ(a.primitives[c].q1.t1, b.primitives[c].q1.t1);
  }
}

TEST(CostModel, ASphereIsSeenFromAPoint) {
  const auto result = make(revolved(sphere_rings), sphere(1)).step(sphere(1), sphere(2));
  ASSERT_EQ(result.primitives.size(), 1u);
  EXPECT_TRUE(result.primitives[0].is_point());
  EXPECT_EQ(result.counts.free_components, 1u);
}

TEST(CostModel, AWavyTubeIsSeenFromALine) {
  const Positions x = wavy_tube(), grown = 1.25 * x;
  const Triangles t = revolved(tube_rings);
  const auto count = static_cast<std::size_t>(t.rows());
  const auto result = make(t, x).step(x, grown);
  ASSERT_EQ(result.primitives.size(), 1u);
  EXPECT_FALSE(result.primitives[0].is_point());
  const auto by_point = make(t, x, Culling::view_point).step(x, grown);
  EXPECT_GE(result.view_positive, by_point.view_positive + count / 16);
}

TEST(CostModel, L10_EveryComponentIsSeenFromWhatSuitsIt) {
  const Triangles tube = revolved(tube_rings), ball = revolved(sphere_rings);
  const Positions x_tube = wavy_tube(), x_ball = sphere(1);
  Triangles t(tube.rows() + ball.rows(), 3);
  t << tube, ball.array() + static_cast<std::int32_t>(x_tube.rows());
  const Positions x = tests::side_by_side(x_tube, x_ball, 20);
  const auto result = make(t, x).step(x, x);
  ASSERT_EQ(result.primitives.size(), 2u);
  EXPECT_FALSE(result.primitives[0].is_point());
  EXPECT_TRUE(result.primitives[1].is_point());
}

constexpr int sheet_side = 49;  // 4,608 triangles
// Its last rows rise, so that those triangles alone have a sign where it is seen along the others.
Positions sheet_positions(int rising_rows) {
  Positions x(sheet_side * sheet_side, 3);
  for (int i = 0; i < sheet_side; ++i) {
    const int risen = std::max(0, i - (sheet_side - 1 - rising_rows));
    for (int j = 0; j < sheet_side; ++j) x.row(i * sheet_side + j) << i, j, .5 * risen;
  }
  return x;
}

// The same triangles, each with its other side in front.
Triangles turned(const Triangles& t) {
  Triangles result(t.rows(), 3);
  result << t.col(0), t.col(2), t.col(1);
  return result;
}

// A sheet seen along itself: integers would decide that the flat triangles have no sign, which
// costs more than what the signs of the others can save.
TEST(CostModel, ALargeSheetIsGlancedAtAndNoMore) {
  const Triangles t = tests::sheet_triangles(sheet_side);
  const ViewPrimitive along = {};
  for (const int rising : {0, 24, 36}) {
    for (const bool is_turned : {false, true}) {
      const Triangles sheet = is_turned ? turned(t) : t;  // the risen triangles have the other sign
      const Positions x = sheet_positions(rising);
      Positions moved = x;
      moved.col(1).array() += .25;
      const auto result = make(sheet, x).step(x, moved, {&along, 1});
      EXPECT_FALSE(was_looked_at(result)) << rising << is_turned;
      EXPECT_TRUE(has_no_views(result)) << rising << is_turned;
      EXPECT_EQ(result.answer, Answer::free);
      expect_same_contacts(result, make(sheet, x, Culling::bvh).step(x, moved));
    }
  }
}

// Most of the sheet passes the point from which it is seen, so it has no sign; a quarter keeps its
// sign. Views would save a sixteenth of the pairs, whichever the sign is.
TEST(CostModel, ALargeSheetWithAFewSignsIsGlancedAtAndNoMore) {
  const Triangles t = tests::sheet_triangles(sheet_side);
  const ViewPrimitive view = {};  // from below, at the origin
  Positions x = sheet_positions(0), moved = x;
  x.col(2).setOnes();
  moved.col(2).setOnes();
  moved.topRows(3 * (sheet_side - 1) / 4 * sheet_side).col(2).setConstant(-1);
  for (const Triangles& sheet : {t, turned(t)}) {
    const auto result = make(sheet, x).step(x, moved, {&view, 1});
    EXPECT_EQ(result.views, ViewUse::hopeless);
    EXPECT_FALSE(was_looked_at(result));
  }
}

// A sheet folded like an accordion. Of an unknown start nothing is clean, so views save nothing.
TEST(CostModel, FallsBackWhereAllIsDirtyAndCostsWhatBvhCosts) {
  constexpr int columns = 24;
  Triangles t(2 * (columns - 1), 3);
  Positions x(2 * columns, 3);
  for (int i = 0; i < columns; ++i) {
    x.row(2 * i) << .125 * i, 0, i % 2;
    x.row(2 * i + 1) << .125 * i, 1, i % 2;
    if (i + 1 == columns) break;
    t.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    t.row(2 * i + 1) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
  }
  Detector views = make(t, x, Culling::view_auto, Start::unknown), bvh = make(t, x, Culling::bvh);
  std::vector<int> looks;
  for (int step = 0; step < 40; ++step) {
    const auto result = views.step(x, x), expected = bvh.step(x, x);
    EXPECT_TRUE(has_no_views(result));
    expect_same_contacts(result, expected);
    EXPECT_EQ(result.counts.search.box_tests, expected.counts.search.box_tests);
    EXPECT_EQ(result.counts.search.candidate_pairs, expected.counts.search.candidate_pairs);
    EXPECT_EQ(result.counts.ghosts.elementary_tests, 0u);
    if (was_looked_at(result)) looks.push_back(step);
  }
  EXPECT_EQ(looks, (std::vector<int>{0, 2, 5, 10, 19, 36})) << "rests of 1, 2, 4, 8, 16 steps";
}

// The pole of a sphere has been pushed out through the other side, so the view shows that not all
// is clean at the start. To find out by layers what is clean would cost as much as the views save.
// So the first step does what culling bvh does, and its pairs tell the second one (L15).
TEST(CostModel, L5L15_AFirstStepIsNotVerifiedByLayers) {
  Positions x = sphere(2);
  x.row(sides * sphere_rings) << 0, 0, 3;
  const Triangles t = revolved(sphere_rings);
  Detector views = make(t, x, Culling::view_auto, Start::verified), bvh = make(t, x, Culling::bvh);
  const auto first = views.step(x, x), expected = bvh.step(x, x);
  EXPECT_EQ(first.answer, Answer::collision);
  EXPECT_EQ(first.views, ViewUse::start_unknown);
  EXPECT_TRUE(has_no_views(first));
  expect_same_contacts(first, expected);
  EXPECT_EQ(first.counts.search.box_tests, expected.counts.search.box_tests);
  EXPECT_EQ(first.counts.narrow.elementary_tests, expected.counts.narrow.elementary_tests);
  EXPECT_EQ(views.step(x, x).views, ViewUse::used);
}

// Turned inside out, an octahedron is V0 altogether; then it breathes.
TEST(CostModel, L5L8_ComesBackWhenViewsPayAgain) {
  const Positions x = octahedron_positions(2);
  Detector detector = make(octahedron(), x), bvh = make(octahedron(), x, Culling::bvh);
  Positions at = x;
  int looks = 0, free = 0;
  for (int step = 0; step < 60; ++step) {
    const bool turns = step < 8;
    const Positions to = turns ? Positions(-at) : octahedron_positions(2 + step % 2);
    const auto result = detector.step(at, to);
    expect_same_contacts(result, bvh.step(at, to));
    EXPECT_TRUE(!turns || has_no_views(result)) << step;
    looks += was_looked_at(result);
    free += result.counts.free_components > 0;
    EXPECT_TRUE(free == 0 || result.counts.search.box_tests == 0)
        << "and stays with them, step " << step;
    at = to;
  }
  EXPECT_GE(free, 40);
  EXPECT_LE(looks, free + 4);
}

// After a step in which most triangles were in contact, the next one, from x to y, does not try to
// release them, and two more rest.
void rest_after_contacts(Detector& detector, const Positions& x, const Positions& y) {
  EXPECT_EQ(detector.step(x, y).views, ViewUse::among_dirty);
  EXPECT_EQ(detector.step(y, y).views, ViewUse::resting);
  EXPECT_EQ(detector.step(y, y).views, ViewUse::resting);
}

TEST(CostModel, L8L9_AnUnclosedMeshIsVerifiedAgainWhenItComesBack) {
  const Triangles all = revolved(sphere_rings);
  const Triangles t = all.bottomRows(all.rows() - 6);
  const Positions x = sphere(1);
  Detector detector = make(t, x), bvh = make(t, x, Culling::bvh);
  // Pressed flat and turned over, without the ghosts being swept: nothing is clean after it.
  Positions over = x;
  over.col(2) *= -.875;
  over.col(2) += .125 * x.col(0) + .0625 * x.col(1);
  EXPECT_TRUE(has_no_views(detector.step(x, over)));
  bvh.step(x, over);
  EXPECT_TRUE(has_no_views(detector.step(over, x))) << "a rest";
  bvh.step(over, x);
  // A dent that is no danger to half of the sphere: neither free, nor without use.
  Positions dented = x;
  dented.row(3 * sides) *= -.5;
  rest_after_contacts(detector, x, dented);
  const auto result = detector.step(dented, x);
  expect_same_contacts(result, bvh.step(dented, x));
  ASSERT_FALSE(has_no_views(result));
  EXPECT_GT(result.view_positive, 50u);
  EXPECT_EQ(result.dirty, 0u) << "layers say so: nothing touches anything at this start";
}

// The primitive hangs on many vertices of the sphere: one of them, pulled far out, takes it along.
TEST(CostModel, L5_ChoosesAgainWhereThePrimitiveNoLongerPays) {
  const Triangles t = revolved(sphere_rings);
  const auto count = static_cast<std::size_t>(t.rows());
  const Positions x = sphere(1);
  Detector detector = make(t, x);
  const Topology& mesh = detector.topology();
  const auto anchor = choose_view_anchor(mesh, mesh.components[0], x.rows(), x).ends[0];
  Positions pulled = x;
  pulled.row(anchor.vertices[0]) *= 1 + 3 / anchor.weights[0];
  for (int step = 0; step < 20; ++step) ASSERT_EQ(detector.step(x, x).view_positive, count);
  const auto worn = detector.step(x, pulled);
  ASSERT_FALSE(has_no_views(worn));
  EXPECT_LT(worn.view_positive, count * 3 / 4);
  const auto first = detector.evaluate(pulled, pulled), again = detector.step(pulled, pulled);
  expect_same_bytes(first, again);
  EXPECT_NE(again.primitives[0].q0.t0, worn.primitives[0].q0.t1);
  EXPECT_EQ(again.view_positive, count);
  EXPECT_EQ(again.counts.winding_numbers, 1u) << "not that of the primitive before";
  const auto next = detector.step(pulled, pulled);
  EXPECT_EQ(next.primitives[0].q0.t0, again.primitives[0].q0.t1);
  EXPECT_EQ(next.counts.winding_numbers, 0u);
}

// Contacts, rests and looks, all of them.
std::vector<Positions> eventful_frames() {
  std::vector<Positions> frames;
  for (int i = 0; i < 30; ++i) {
    const auto x = octahedron_positions(2 + i % 3);
    frames.push_back(i % 7 == 3 ? Positions(-x) : i % 7 == 5 ? pushed_octahedron() : x);
  }
  return frames;
}

TEST(CostModel, EvaluateLeavesTheChoiceAloneAndResetForgetsIt) {
  const auto frames = eventful_frames();
  Detector plain = make(octahedron(), frames[0]), evaluator = make(octahedron(), frames[0]);
  int without = 0, with = 0;
  const auto play = [&] {
    for (std::size_t f = 0; f + 1 < frames.size(); ++f) {
      for (std::size_t other = 0; other < 6; ++other) evaluator.evaluate(frames[f], frames[other]);
      const auto expected = plain.step(frames[f], frames[f + 1]);
      expect_same_bytes(evaluator.step(frames[f], frames[f + 1]), expected);
      ++(has_no_views(expected) ? without : with);
    }
  };
  play();
  EXPECT_GT(without, 3);
  EXPECT_GT(with, 3);
  plain.reset();
  evaluator = make(octahedron(), frames[0]);
  play();
}

// The flat pressing and the passage through the hole below happen without views. What is dirty
// after them is what a verified start says, by the ghosts too: some are pierced already there.
TEST(CostModel, L15_AfterStepsWithoutViewsDirtyIsAsAtANewStart) {
  const Triangles all = revolved(sphere_rings);
  const Triangles t = all.bottomRows(all.rows() - 1);
  const Positions x = sphere(1);
  Positions over = x;
  over.col(2) *= -.875;
  over.col(2) += .125 * x.col(0) + .0625 * x.col(1);
  // Vertex 68 stands opposite to the hole; through it, and well beyond.
  Positions out = x;
  out.row(68) = .5 * (x.row(0) + x.row(1) + x.row(9));
  Positions next = out;
  next.row(68) *= 1.125;
  Detector anew = make(t, x, Culling::view_point, Start::verified);
  const auto expected = anew.step(out, next);
  ASSERT_FALSE(has_no_views(expected));
  EXPECT_GE(expected.violated, 5u);
  EXPECT_GE(expected.dirty, 5u);
  // The word that the start is clean is given for the first step alone.
  for (const auto start : {Start::verified, Start::clean}) {
    Detector detector = make(t, x, Culling::view_auto, start);
    EXPECT_TRUE(start == Start::clean || detector.step(x, x).views == ViewUse::used)
        << "all of it is positive";
    EXPECT_EQ(detector.step(x, over).views, ViewUse::saving_too_little);
    EXPECT_EQ(detector.step(over, out).views, ViewUse::resting);
    rest_after_contacts(detector, out, out);
    const auto result = detector.step(out, next);
    ASSERT_EQ(result.doubts.size(), expected.doubts.size());
    for (std::size_t i = 0; i < expected.doubts.size(); ++i)
      EXPECT_EQ(result.doubts[i] & doubt::dirty, expected.doubts[i] & doubt::dirty) << i;
    expect_same_contacts(result, expected);
  }
}

TEST(CostModel, AdjacentPairsAreThoseThatShareAVertex) {
  const Surface surface = make_surface(octahedron(), 6);
  // Of 28 pairs the four of opposite triangles share none.
  EXPECT_EQ(adjacent_pairs(surface.mesh), 24u);
}

}  // namespace
}  // namespace assay::detector
