// Steps that are stopped, at each call of the stop function in turn. Such a step is undecided, and
// leaves no trace.
#include "detector/detector.h"
#include "detector/mesh/paced_stop.h"
#include "tests/asked.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::tip_at;

Detector make(const Triangles& triangles, const Positions& x, Options options,
              bool keeps_near = false) {
  options.keeps_near = keeps_near;
  return std::move(Detector::create(triangles, x, options).value());
}

// Small meshes: each stage asks when it begins, and no more often than every 256 tests.
constexpr int most_askings = 8;

void stop_everywhere(Detector& detector, const Positions& x_t0, const Positions& x_t1) {
  int askings = 0;
  const auto count = [&] { return ++askings, false; };
  const StepResult whole = detector.evaluate(x_t0, x_t1, {}, count);
  ASSERT_NE(whole.answer, Answer::undecided);
  ASSERT_GT(askings, 0);
  EXPECT_LE(askings, most_askings);
  const int all = askings;
  // What begins elsewhere leaves nothing that serves this step (L20).
  const auto forget = [&] { detector.evaluate(x_t1, x_t0); };
  const auto stop_at = [&](int n) {
    SCOPED_TRACE(n);
    int calls = 0;
    const auto stop = [&] { return ++calls == n; };
    EXPECT_EQ(detector.evaluate(x_t0, x_t1, {}, stop).answer, Answer::undecided);
    EXPECT_EQ(calls, n) << "and nothing is asked afterwards";
    ASSERT_TRUE(detector.commit()) << "nothing to commit";
  };
  for (int n = 1; n <= all; ++n) {
    forget();
    stop_at(n);
  }
  forget();
  detector.evaluate(x_t0, x_t1);
  askings = 0;
  detector.evaluate(x_t0, x_t1, {}, count);
  ASSERT_GT(askings, 0) << "asked again";
  for (int n = 1, again = askings; n <= again; ++n) stop_at(n);
  const StepResult again = detector.evaluate(x_t0, x_t1);
  tests::expect_same_contacts(again, whole);
  EXPECT_EQ(again.doubts, whole.doubts);
  EXPECT_EQ(again.signs, whole.signs);
}

class Stop : public testing::TestWithParam<Culling> {};

TEST_P(Stop, InAClosedMeshThatCollides) {
  const Positions x = octahedron_positions(2);
  for (const bool keeps_near : {false, true}) {
    auto detector = make(octahedron(), x, {GetParam()}, keeps_near);
    stop_everywhere(detector, x, tip_at({.5, .25, 3}));
  }
}

TEST_P(Stop, WhereContactsLastFromTheStepBefore) {
  const Positions x = octahedron_positions(2), through = tip_at({.5, .25, 3});
  for (const bool keeps_near : {false, true}) {
    auto detector = make(octahedron(), x, {GetParam()}, keeps_near);
    ASSERT_EQ(detector.step(x, through).answer, Answer::collision);
    stop_everywhere(detector, through, tip_at({.5, .25, 2.5}));
  }
}

TEST_P(Stop, WhereGhostsAreSweptAndDoubtIsReleased) {
  const Positions in = octahedron_positions(2), out = tip_at(1.5);
  // Without its triangle at +x +y +z.
  for (const bool keeps_near : {false, true}) {
    auto detector = make(octahedron().bottomRows(7), in, {GetParam()}, keeps_near);
    stop_everywhere(detector, in, out);
    detector.step(in, out);
    stop_everywhere(detector, out, in);
  }
}

// Each component is too small to ask by itself; together their view tests take integers, 3 us each.
TEST(StopInASoup, IsAskedAcrossComponents) {
  constexpr int count = 400;
  Triangles triangles(count, 3);
  Positions x(3 * count, 3);
  for (int i = 0; i < count; ++i) {
    triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
    x.row(3 * i) << i, 0, 0;
    x.row(3 * i + 1) << i + .5, 0, .25;
    x.row(3 * i + 2) << i, .5, .125;
  }
  auto detector = make(triangles, x, {Culling::view_point});
  std::uint64_t calls = 0;
  const StepResult result = detector.evaluate(x, x, {}, [&] { return ++calls, false; });
  ASSERT_GE(result.counts.view.exact, std::uint64_t{count});
  EXPECT_GE(calls, result.counts.view.exact * 600 / PacedStop::usual_interval);
  EXPECT_LE(calls, std::uint64_t{count}) << "and not for each component";
}

INSTANTIATE_TEST_SUITE_P(Cullings, Stop,
                         testing::Values(Culling::view_point, Culling::view_line,
                                         Culling::normal_cone, Culling::bvh, Culling::none),
                         tests::culling_of_test);

// Creating and stepping on a mesh that takes a while asks the stop function as work is done; what a
// stop leaves behind does not change what is answered afterwards.

constexpr int bent_squares = 64;
constexpr std::uint64_t triangle_count = 2 * bent_squares * bent_squares;
const Triangles bent_sheet = tests::squares(bent_squares, bent_squares);

// A sheet of unit squares, bent over until its two ends pass through each other.
Positions bent(double angle) {
  constexpr int side = bent_squares + 1;
  Positions x(side * side, 3);
  const double radius = bent_squares / angle;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double a = angle * i / bent_squares - angle / 2;
      const double r = radius + .03 * ((7 * i + 3 * j) % 5) + .02 * j;
      x.row(i * side + j) << r * std::sin(a), j, r * std::cos(a);
    }
  }
  return x;
}

class StopInAStep : public testing::TestWithParam<Culling> {};

// What only some cullings need is made in the first step that uses it.
TEST(StopInALargeMesh, IsAskedInCreate) {
  std::uint64_t calls = 0;
  ASSERT_TRUE(Detector::create(bent_sheet, bent(6), {}, [&] { return ++calls, false; }));
  // Checks, adjacency and tree alone.
  EXPECT_GE(calls, 150 * triangle_count / PacedStop::usual_interval);
}

TEST_P(StopInAStep, OfALargeMeshIsAsked) {
  const Positions x_t0 = bent(6.1), x_t1 = bent(6.3);
  const Options options{GetParam(), Start::clean};
  auto detector = make(bent_sheet, x_t0, options);
  std::uint64_t calls = 0;
  const StepResult whole = detector.evaluate(x_t0, x_t1, {}, [&] { return ++calls, false; });
  ASSERT_EQ(whole.answer, Answer::collision);
  // Boxes, marks and representatives alone.
  EXPECT_GE(calls, 40 * triangle_count / PacedStop::usual_interval);
  const std::uint64_t all = calls;
  const std::uint64_t apart = std::max<std::uint64_t>(all / tests::usual(24), 1);
  for (std::uint64_t n = 1; n <= all; n += apart) {
    SCOPED_TRACE(n);
    auto other = make(bent_sheet, x_t0, options);
    calls = 0;
    EXPECT_EQ(other.evaluate(x_t0, x_t1, {}, [&] { return ++calls == n; }).answer,
              Answer::undecided);
    EXPECT_EQ(calls, n) << "and nothing is asked afterwards";
    const StepResult again = other.evaluate(x_t0, x_t1);
    tests::expect_same_contacts(again, whole);
    EXPECT_EQ(again.counts.narrow.elementary_tests, whole.counts.narrow.elementary_tests);
  }
}

INSTANTIATE_TEST_SUITE_P(Cullings, StopInAStep,
                         testing::Values(Culling::view_auto, Culling::view_point,
                                         Culling::normal_cone, Culling::bvh),
                         tests::culling_of_test);

}  // namespace
}  // namespace assay::detector
