// A step that is stopped, at each asking in turn: undecided, and as if it had not been.
#include "detector/detector.h"
#include "tests/detector/contact/same_contacts.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions;

// The tip at -z elsewhere.
Positions tip_at(Point p) {
  Positions x = octahedron_positions(2);
  x.row(5) << p[0], p[1], p[2];
  return x;
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
  for (int n = 1; n <= all; ++n) {
    SCOPED_TRACE(n);
    int asked = 0;
    const auto stop = [&] { return ++asked == n; };
    EXPECT_EQ(detector.evaluate(x_t0, x_t1, {}, stop).answer, Answer::undecided);
    EXPECT_EQ(asked, n) << "and nothing is asked afterwards";
    ASSERT_TRUE(detector.commit()) << "nothing to commit";
  }
  const StepResult again = detector.evaluate(x_t0, x_t1);
  tests::expect_same_contacts(again, whole);
  EXPECT_EQ(again.doubts, whole.doubts);
  EXPECT_EQ(again.signs, whole.signs);
}

class Stop : public testing::TestWithParam<Culling> {};

TEST_P(Stop, InAClosedMeshThatCollides) {
  const Positions x = octahedron_positions(2);
  auto detector = std::move(Detector::create(octahedron(), x, {GetParam()}).value());
  stop_everywhere(detector, x, tip_at({.5, .25, 3}));
}

TEST_P(Stop, WhereContactsLastFromTheStepBefore) {
  const Positions x = octahedron_positions(2), through = tip_at({.5, .25, 3});
  auto detector = std::move(Detector::create(octahedron(), x, {GetParam()}).value());
  ASSERT_EQ(detector.step(x, through).answer, Answer::collision);
  stop_everywhere(detector, through, tip_at({.5, .25, 2.5}));
}

TEST_P(Stop, WhereGhostsAreSweptAndDoubtIsReleased) {
  const Positions in = octahedron_positions(2), out = tip_at({1.5, 1.5, 1.5});
  // Without its triangle at +x +y +z.
  auto detector = std::move(Detector::create(octahedron().bottomRows(7), in, {GetParam()}).value());
  stop_everywhere(detector, in, out);
  detector.step(in, out);
  stop_everywhere(detector, out, in);
}

std::string name_of_culling(const testing::TestParamInfo<Culling>& info) {
  const char* names[] = {"view_auto", "view_point", "view_line", "normal_cone", "bvh", "none"};
  return names[static_cast<int>(info.param)];
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
  auto detector = std::move(Detector::create(triangles, x, {Culling::view_point}).value());
  std::uint64_t asked = 0;
  const StepResult result = detector.evaluate(x, x, {}, [&] { return ++asked, false; });
  ASSERT_GE(result.counts.view.exact, std::uint64_t{count});
  EXPECT_GE(asked, result.counts.view.exact * 600 / PacedStop::usual_interval);
  EXPECT_LE(asked, std::uint64_t{count}) << "and not for each component";
}

INSTANTIATE_TEST_SUITE_P(Cullings, Stop,
                         testing::Values(Culling::view_point, Culling::view_line,
                                         Culling::normal_cone, Culling::bvh, Culling::none),
                         name_of_culling);

}  // namespace
}  // namespace assay::detector
