// The exact sign of a 3x3 determinant of coordinate differences, in doubles with a bound first, in
// integers if these cannot tell.
#pragma once

#include "detector/mesh/types.h"

namespace assay::detector {

// The sign of det(b-a, c-a, d-a): 1 if a, b, c, d are oriented like 0, e_x, e_y, e_z. Exact for
// all finite inputs. 10 ns; 1 us if the determinant is near zero.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

// Whether the open segment e0e1 strictly pierces the open triangle, both at rest: its ends are
// strictly on opposite sides of the triangle's plane, and its line passes strictly inside the
// three edges. Exact for all finite inputs.
bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

}  // namespace assay::detector
