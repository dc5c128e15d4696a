// Shorthand for the tests of this folder.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

namespace assay::tests {

using detector::MovingPoint;
using detector::Point;

inline MovingPoint still(Point p) { return {p, p}; }

inline detector::Positions positions(std::initializer_list<Point> rows) {
  detector::Positions x(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    for (int k = 0; k < 3; ++k) x(i, k) = row[static_cast<std::size_t>(k)];
    ++i;
  }
  return x;
}

inline detector::Triangles triangles(std::initializer_list<std::array<std::int32_t, 3>> rows) {
  detector::Triangles t(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    for (int k = 0; k < 3; ++k) t(i, k) = row[static_cast<std::size_t>(k)];
    ++i;
  }
  return t;
}

// Outward octahedron of radius `r`: vertices +x -x +y -y +z -z from `first`.
inline detector::Triangles octahedron() {
  return triangles(
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}
inline detector::Positions octahedron_positions(double r) {
  return positions({{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}});
}

// The octahedron of radius 2 whose apex is pulled out through its side.
inline detector::Positions pushed_octahedron() {
  detector::Positions x = octahedron_positions(2);
  x.row(4) << 3, .5, -.25;
  return x;
}

}  // namespace assay::tests
