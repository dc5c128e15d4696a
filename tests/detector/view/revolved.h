// Closed surfaces of revolution: a sphere, and a tube with waists.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::tests {

using detector::Positions, detector::Triangles;

// A closed surface of revolution: rings of eight vertices, then the two poles.
inline constexpr std::int32_t sides = 8;
inline Triangles revolved(std::int32_t rings) {
  Triangles t(2 * sides * rings, 3);
  Eigen::Index row = 0;
  for (std::int32_t i = 0; i < sides; ++i) {
    const std::int32_t j = (i + 1) % sides, last = (rings - 1) * sides;
    for (std::int32_t at = 0; at < last; at += sides) {
      t.row(row++) << at + i, at + j, at + sides + j;
      t.row(row++) << at + i, at + sides + j, at + sides + i;
    }
    t.row(row++) << j, i, rings * sides;
    t.row(row++) << last + i, last + j, rings * sides + 1;
  }
  return t;
}

struct Ring {
  double z, r;
};
inline Positions revolved(const std::vector<Ring>& rings, double end_below, double end_above) {
  const auto n = static_cast<Eigen::Index>(rings.size());
  Positions x(n * sides + 2, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto [z, r] = rings[static_cast<std::size_t>(k)];
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      x.row(k * sides + i) << r * std::cos(angle), r * std::sin(angle), z;
    }
  }
  x.row(n * sides) << 0, 0, end_below;
  x.row(n * sides + 1) << 0, 0, end_above;
  return x;
}

// A tube whose waists hide most of its surface from every point.
inline constexpr std::int32_t tube_rings = 40;
inline Positions wavy_tube() {
  std::vector<Ring> rings;
  for (int k = 0; k < tube_rings; ++k) rings.push_back({1. * k, k % 4 < 2 ? 3. : 1.});
  return revolved(rings, -1, tube_rings);
}

inline constexpr std::int32_t sphere_rings = 9;
inline Positions sphere(double radius) {
  std::vector<Ring> rings;
  for (int k = 1; k <= sphere_rings; ++k) {
    const double angle = std::numbers::pi * k / (sphere_rings + 1);
    rings.push_back({-radius * std::cos(angle), radius * std::sin(angle)});
  }
  return revolved(rings, -radius, radius);
}

}  // namespace assay::tests
