// Creating and stepping on a mesh that takes a while asks the stop function as work is done; what a
// stop leaves behind does not change what is answered afterwards.
#include "detector/detector.h"
#include "detector/mesh/paced_stop.h"
#include "tests/detector/contact/same_contacts.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

constexpr int squares = 64;
constexpr std::uint64_t triangle_count = 2 * squares * squares;

// A sheet of unit squares, bent over until its two ends pass through each other.
Positions bent(double angle) {
  constexpr int side = squares + 1;
  Positions x(side * side, 3);
  const double radius = squares / angle;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double a = angle * i / squares - angle / 2;
      const double r = radius + .03 * ((7 * i + 3 * j) % 5) + .02 * j;
      x.row(i * side + j) << r * std::sin(a), j, r * std::cos(a);
    }
  }
  return x;
}

Triangles sheet() {
  constexpr int side = squares + 1;
  Triangles t(static_cast<Eigen::Index>(triangle_count), 3);
  Eigen::Index row = 0;
  for (int i = 0; i < squares; ++i) {
    for (int j = 0; j < squares; ++j) {
      const int v = i * side + j;
      t.row(row++) << v, v + side, v + side + 1;
      t.row(row++) << v, v + side + 1, v + 1;
    }
  }
  return t;
}

class StopInAStep : public testing::TestWithParam<Culling> {};

// What only some cullings need is made in the first step that uses it.
TEST(StopInALargeMesh, IsAskedInCreate) {
  const Positions x = bent(6);
  const Options options{Culling::automatic};
  std::uint64_t asked = 0;
  ASSERT_TRUE(Detector::create(sheet(), x, options, [&] { return ++asked, false; }));
  // Checks, adjacency and tree alone.
  EXPECT_GE(asked, 150 * triangle_count / PacedStop::usual_interval);
  const std::uint64_t all = asked;
  for (std::uint64_t n = 1; n <= all; ++n) {
    asked = 0;
    const auto stopped = Detector::create(sheet(), x, options, [&] { return ++asked == n; });
    ASSERT_FALSE(stopped) << n;
    EXPECT_EQ(stopped.error().error, InputError::stopped);
    EXPECT_EQ(asked, n) << "and nothing is asked afterwards";
  }
}

TEST_P(StopInAStep, OfALargeMeshIsAsked) {
  const Positions x_t0 = bent(6.1), x_t1 = bent(6.3);
  const Options options{GetParam(), Start::clean};
  auto detector = std::move(Detector::create(sheet(), x_t0, options).value());
  std::uint64_t asked = 0;
  const auto count = [&] { return ++asked, false; };
  const StepResult whole = detector.evaluate(x_t0, x_t1, {}, count);
  ASSERT_EQ(whole.answer, Answer::collision);
  // Boxes, marks and representatives alone.
  EXPECT_GE(asked, 40 * triangle_count / PacedStop::usual_interval);
  const std::uint64_t all = asked;
  const std::uint64_t apart = std::max<std::uint64_t>(all / 24, 1);
  for (std::uint64_t n = 1; n <= all; n += apart) {
    SCOPED_TRACE(n);
    auto other = std::move(Detector::create(sheet(), x_t0, options).value());
    asked = 0;
    EXPECT_EQ(other.evaluate(x_t0, x_t1, {}, [&] { return ++asked == n; }).answer,
              Answer::undecided);
    EXPECT_EQ(asked, n) << "and nothing is asked afterwards";
    const StepResult again = other.evaluate(x_t0, x_t1);
    tests::expect_same_contacts(again, whole);
    EXPECT_EQ(again.counts.narrow.elementary_tests, whole.counts.narrow.elementary_tests);
  }
}

std::string name_of(const testing::TestParamInfo<Culling>& info) {
  const char* names[] = {"view_auto", "view_point", "view_line", "normal_cone", "bvh"};
  return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Cullings, StopInAStep,
                         testing::Values(Culling::view_auto, Culling::view_point,
                                         Culling::normal_cone, Culling::bvh),
                         name_of);

}  // namespace
}  // namespace assay::detector
