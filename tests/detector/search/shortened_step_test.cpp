// The places at a time, against exact arithmetic: they are off by less than the slack allows.
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "detector/boxes/moving_box.h"
#include "detector/search/feature_pairs.h"
#include "detector/search/search_lanes.h"
#include "tests/detector/search/compared_features.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

using Rational = boost::multiprecision::cpp_rational;

TEST(ShortenedStep, PlacesAreOffByAQuarterOfTheSlackAtMost) {
  std::mt19937_64 engine(41);
  const auto full = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1; };
  for (const int exponent : {0, 1023, -1060, 40}) {
    Positions x_t0(50, 3), x_t1(50, 3);
    for (Eigen::Index i = 0; i < x_t0.size(); ++i) {
      const double far = i % 5 == 0 ? std::ldexp(1., -40) : 1;
      x_t0.data()[i] = std::ldexp(full(), exponent) * far;
      x_t1.data()[i] = std::ldexp(full(), exponent);
    }
    for (const double until : {.5, 1. / 3, 1e-9, 0x1p-1074, std::nextafter(1., 0.)}) {
      PacedStop pace(never_stops);
      const ShortenedStep shortened({x_t0, x_t1}, until, pace);
      const Rational allowed = Rational(shortened.slack()) / 4;
      ASSERT_GT(shortened.slack(), 0);
      EXPECT_LE(shortened.slack(), std::ldexp(1., exponent - 47) + 0x1p-1069);
      for (Eigen::Index v = 0; v < 50; ++v) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          const Rational exact = Rational(x_t0(v, k)) +
                                 Rational(until) * (Rational(x_t1(v, k)) - Rational(x_t0(v, k)));
          const Rational off = Rational(shortened.motion().vertices_t1(v, k)) - exact;
          EXPECT_LE(off, allowed);
          EXPECT_GE(off, -allowed);
          EXPECT_EQ(shortened.motion().vertices_t0(v, k), x_t0(v, k));
        }
      }
    }
  }
}

TEST(ShortenedStep, AtTheStartItIsExact) {
  const Positions x_t0 = Positions::Constant(2, 3, .1), x_t1 = Positions::Constant(2, 3, 7);
  PacedStop pace(never_stops);
  const ShortenedStep shortened({x_t0, x_t1}, 0, pace);
  EXPECT_EQ(shortened.slack(), 0);
  EXPECT_EQ(shortened.motion().vertices_t1, x_t0);
}

// Two vertices on a line, one of which has caught up with the other at the bound, by less than the
// places there are rounded. Some places then lie in the old order, and only the slack keeps the
// boxes from being apart.
TEST(ShortenedStep, WhatMeetsByTheBoundIsNotApart) {
  std::mt19937_64 engine(43);
  const auto full = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53); };
  constexpr double until = .9;
  const auto exactly = [&](const Positions& x_t0, const Positions& x_t1,
                           Eigen::Index v) -> Rational {
    return Rational(x_t0(v, 0)) + Rational(until) * (Rational(x_t1(v, 0)) - Rational(x_t0(v, 0)));
  };
  int in_old_order = 0;
  for (int i = 0; i < 1'000; ++i) {
    Positions x_t0 = Positions::Zero(2, 3), x_t1 = Positions::Zero(2, 3);
    x_t0(0, 0) = full();
    x_t1(0, 0) = 1 + full();
    x_t0(1, 0) = x_t0(0, 0) + 8 * full();
    const double there = place_between(x_t0(0, 0), x_t1(0, 0), until);
    x_t1(1, 0) = (there - (1 - until) * x_t0(1, 0)) / until;
    while (exactly(x_t0, x_t1, 1) > exactly(x_t0, x_t1, 0))
      x_t1(1, 0) = std::nextafter(x_t1(1, 0), -10.);
    PacedStop pace(never_stops);
    const ShortenedStep shortened({x_t0, x_t1}, until, pace);
    const auto& end = shortened.motion().vertices_t1;
    in_old_order += end(0, 0) < end(1, 0);
    const FeaturePoints points(shortened.motion(), nullptr, shortened.slack());
    EXPECT_FALSE(tests::are_apart(points, {0, 0}, {1, 1}, points.margin()));
  }
  EXPECT_GT(in_old_order, 10);
}

TEST(SearchRounds, EachNumberComesOnce) {
  for (std::size_t count : {0u, 1u, 2u, 3u, 37u, 64u, 511u, 512u, 600u}) {
    auto numbers = spread_numbers(count);
    ASSERT_EQ(numbers.size(), count);
    std::sort(numbers.begin(), numbers.end());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(numbers[i], i);
  }
  const auto numbers = spread_numbers(512);
  EXPECT_EQ(numbers[1], 256u);
  EXPECT_EQ(numbers[3], 384u);
}

}  // namespace
}  // namespace assay::detector
