#include <numbers>

#include "detector/traditional/moving_contour.h"
#include "tests/detector/exact/exact_numbers.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// Directions as exact numbers.
Exact along(const ExactVector& n, int bit) {
  const Direction d = direction(bit);
  return dot(n, {Exact(d[0]), Exact(d[1]), Exact(d[2])});
}

TEST(Facing, L13_WhatIsFacedIsFacedAtEveryTime) {
  std::mt19937_64 engine(1309);
  int faced = 0, unfaced = 0;
  for (int round = 0; round < 1500; ++round) {
    // From steps so short that little turns to long ones, with flat and far-off triangles.
    const double move = std::ldexp(1.0, -static_cast<int>(engine() % 40));
    const double offset = engine() % 3 ? 0 : 1e6;
    std::array<MovingPoint, 3> triangle;
    for (auto& p : triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = [&] { return static_cast<double>(engine() % 4096) / 2048 - 1; };
        p.t0[k] = offset + (k == 2 && round % 5 == 0 ? 0 : number());
        p.t1[k] = p.t0[k] + move * number();
      }
    }
    const DirectionSet set = faced_directions(triangle);
    const MovingExact e1 = exact_difference(triangle[1], triangle[0]);
    const MovingExact e2 = exact_difference(triangle[2], triangle[0]);
    for (int bit = 0; bit < facing_directions; ++bit) {
      const bool is_faced = (set >> bit & 1) != 0;
      double least = HUGE_VAL;
      bool negative = false;
      constexpr int times = 16;
      for (int i = 0; i <= times; ++i) {
        const Exact t(i / static_cast<double>(times)), s(1 - i / static_cast<double>(times));
        const auto mean = [&](const MovingExact& e) {
          ExactVector out;
          for (std::size_t k = 0; k < 3; ++k) out[k] = s * e.t0[k] + t * e.t1[k];
          return out;
        };
        const Exact value = along(cross(mean(e1), mean(e2)), bit);
        negative |= value.number <= 0;
        least = std::min(least, value.number <= 0 ? 0 : magnitude(value));
      }
      EXPECT_FALSE(is_faced && negative) << round << ", direction " << bit;
      // Short steps leave a margin for the Bernstein coefficients.
      if (move < 0x1p-10 && least > 0.05) {
        EXPECT_TRUE(is_faced) << round;
      }
      (is_faced ? faced : unfaced)++;
    }
  }
  EXPECT_GT(faced, 5000);
  EXPECT_GT(unfaced, 5000);
}

TEST(Facing, DirectionsAreDistinctAndLeaveNoGap) {
  std::mt19937_64 engine(5);
  for (int i = 0; i < 2000; ++i) {
    Vector v;
    for (double& c : v) c = static_cast<double>(engine() % 20001) / 10000 - 1;
    const Direction d = direction(nearest_direction((DirectionSet{1} << facing_directions) - 1, v));
    const double cosine = dot(d, v) / std::sqrt(dot(d, d) * dot(v, v));
    EXPECT_GT(cosine, std::cos(23 * std::numbers::pi / 180));
  }
}

}  // namespace
}  // namespace assay::detector
