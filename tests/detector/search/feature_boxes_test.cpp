// What diagonals tell apart is strictly ordered along one of them in exact arithmetic.
#include <boost/multiprecision/cpp_int.hpp>

#include "detector/detector.h"
#include "tests/detector/points.h"
#include "tests/detector/search/compared_features.h"

namespace assay::tests {
namespace {

using namespace detector;
using Rational = boost::multiprecision::cpp_rational;

constexpr std::array<std::array<int, 3>, 4> directions = {
    {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};

Rational along(const std::array<int, 3>& d, const Positions& x, std::int32_t v) {
  return d[0] * Rational(x(v, 0)) + d[1] * Rational(x(v, 1)) + d[2] * Rational(x(v, 2));
}

// In one sense at both ends, along some diagonal.
bool ordered(const Positions& x_t0, const Positions& x_t1, std::int32_t a, std::int32_t b) {
  for (const auto& d : directions) {
    const Rational t0 = along(d, x_t0, a) - along(d, x_t0, b);
    const Rational t1 = along(d, x_t1, a) - along(d, x_t1, b);
    if ((t0 < 0 && t1 < 0) || (t0 > 0 && t1 > 0)) return true;
  }
  return false;
}

// With this margin axes tell nothing apart.
FeatureMargin of_diagonals_alone() {
  constexpr float beyond_all = std::numeric_limits<float>::infinity();
  FeatureMargin margin;
  margin.axes = FloatLanes{beyond_all, beyond_all, beyond_all, beyond_all};
  return margin;
}

TEST(FeatureBoxes, L3_ApartAlongDiagonalsIsOrderedExactly) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::mt19937_64 engine(3);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(engine() % n); };
  std::size_t told_apart = 0, close = 0;
  for (int round = 0; round < 30000; ++round) {
    const int family = round % 6;
    Positions x[2] = {Positions(4, 3), Positions(4, 3)};
    for (auto& frame : x) {
      for (Eigen::Index i = 0; i < 12; ++i) {
        double& c = frame.data()[i];
        if (family == 0) c = below(3) - 1;
        if (family == 1) c = below(1 << 20) * 0x1p-19 - 1;
        // Sums that differ by about the margin, near the middle and at the border.
        if (family == 2) c = (below(3) - 1) + (below(9) - 4) * 0x1p-21;
        if (family == 3) c = 1e9 + below(3) + (below(9) - 4) * 0x1p-20;
        if (family == 4) c = (below(5) - 2) * (largest / 2);
        if (family == 5) c = below(5) * std::numeric_limits<double>::denorm_min();
      }
    }
    const FeaturePoints points({x[0], x[1]});
    const bool is_apart = are_apart(points, {0, 0}, {1, 1}, of_diagonals_alone());
    const bool is_ordered = ordered(x[0], x[1], 0, 1);
    EXPECT_TRUE(!is_apart || is_ordered);
    told_apart += is_apart;
    close += is_ordered && !is_apart;
  }
  EXPECT_GT(told_apart, 5000u);
  EXPECT_GT(close, 100u);
}

// A vertex touches the middle of an edge of a face; all lie in one plane x + y + z = s. Doubles
// round their sums to s or to a neighbour of s, and the middle of two floats lies between these.
// So the vertex may be rounded to the float above and the face to the float below. The margin
// keeps them together.
TEST(FeatureBoxes, L3_WhatTouchesBetweenTwoFloatsIsFound) {
  constexpr double s = 1 + 0x1p-24 + 0x1p-52;
  std::mt19937_64 engine(4);
  const auto between = [&](double lo, double hi) {
    const auto steps = static_cast<std::uint64_t>((hi - lo) * 0x1p53);
    return lo + static_cast<double>(engine() % steps) * 0x1p-53;
  };
  const auto in_plane = [](double y0, double y1) { return Point{y0, y1, s - y0 - y1}; };
  // The first vertex touches the face 3, 4, 5. The others hold the middle of all positions at 0.
  const Triangles mesh = triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  for (int round = 0; round < 2000; ++round) {
    const double p0 = between(.6, .8), p1 = between(.6, .8), d0 = between(0, .1),
                 d1 = between(0, .1);
    const Point p = in_plane(p0, p1), c = in_plane(between(.8, 1), between(.8, 1));
    const Positions x = positions({p,
                                   {p[0] + .5, p[1] + .25, p[2] + .25},
                                   {p[0] + .25, p[1] + .5, p[2] + .25},
                                   in_plane(p0 + d0, p1 + d1),
                                   in_plane(p0 - d0, p1 - d1),
                                   c,
                                   {-4, -4, -4},
                                   {-4, -3.5, -4},
                                   {-3.5, -4, -4},
                                   {4, 4, 4},
                                   {4, 3.5, 4},
                                   {3.5, 4, 4}});
    auto detector = std::move(Detector::create(mesh, x, {Culling::bvh}).value());
    ASSERT_EQ(detector.evaluate(x, x).answer, Answer::collision) << round;
  }
}

// Neither the axes nor a diagonal tells these apart; one of each alone does.
TEST(FeatureBoxes, AxesAndDiagonals) {
  const Positions x = positions({{0, 0, 0}, {1, -1, 0}, {.9, .9, 0}, {1.5, -.5, .1}});
  const FeaturePoints points({x, x});
  constexpr float beyond_all = std::numeric_limits<float>::infinity();
  FeatureMargin of_axes;
  of_axes.diagonals = FloatLanes{beyond_all, beyond_all, beyond_all, beyond_all};
  EXPECT_FALSE(are_apart(points, {0, 1}, {2, 3}, of_axes));
  EXPECT_TRUE(are_apart(points, {0, 1}, {2, 3}, {}));
  EXPECT_FALSE(are_apart(points, {0, 1}, {0, 1}, {}));
}

}  // namespace
}  // namespace assay::tests
