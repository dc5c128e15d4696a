// Exact sign of a 3x3 determinant of coordinate differences: doubles with a bound first, integers
// where they cannot tell.
#pragma once

#include "detector/mesh/types.h"

namespace assay::detector {

// Sign of det(b-a, c-a, d-a): 1 when a, b, c, d are oriented like 0, e_x, e_y, e_z. Exact for all
// finite inputs. 10 ns, 1 us when near zero.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

// Whether the open segment e0e1 strictly pierces the open triangle (no motion): the ends strictly
// on opposite sides of its plane, the line strictly inside its three edges.
bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

}  // namespace assay::detector
