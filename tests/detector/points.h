// Shorthand for the tests of this folder.
#pragma once

#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::tests {

using detector::MovingPoint, detector::Point;

inline MovingPoint still(Point p) { return {p, p}; }

// The octahedron of radius `r`.
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
