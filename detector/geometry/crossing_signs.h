// How a ray crosses a triangle, from the signs of determinants.
//
// Let A, B, C be the corners less the ray's origin and r its direction. The ray's line crosses the
// inside of the triangle if and only if det(A,B,r), det(B,C,r) and det(C,A,r) have one strict
// sign. That sign is then the sign of r . normal, because r . normal is their sum. The crossing is
// ahead of the origin if det(A,B,C) has that sign too.
#pragma once

#include <array>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/types.h"

namespace assay::detector {

using RayOrigin = std::array<Point, 3>;  // stands for the point (2 o[0] + o[1] + o[2]) / 4
using RayDirection = std::array<int, 3>;

// The signs of det(A,B,r), det(B,C,r), det(C,A,r), det(A,B,C), in this order.
using CrossingSigns = std::array<int, 4>;

// Exact arithmetic gives the true signs. Bounded arithmetic gives 0 for a sign that doubles cannot
// tell. Plain doubles and floats give the signs as computed. About 30 ns if doubles can tell.
CrossingSigns crossing_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r, Arithmetic arithmetic);

}  // namespace assay::detector
