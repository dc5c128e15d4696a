// Where a ray crosses a triangle, by signs of determinants.
//
// With A, B, C the corners less the origin and r the direction, the line crosses the triangle's
// inside where det(A,B,r), det(B,C,r), det(C,A,r) have one strict sign, which is then that of
// r . normal (their sum); the crossing is ahead of the origin when det(A,B,C) has that sign too.
#pragma once

#include <array>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/types.h"

namespace assay::detector {

using RayOrigin = std::array<Point, 3>;  // (2 o[0] + o[1] + o[2]) / 4
using RayDirection = std::array<int, 3>;

// Of det(A,B,r), det(B,C,r), det(C,A,r), det(A,B,C).
using CrossingSigns = std::array<int, 4>;

// Exact arithmetic: the signs. Bounded: 0 where doubles cannot tell. Plain doubles and floats: what
// comes out. About 30 ns where doubles can tell.
CrossingSigns crossing_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r, Arithmetic arithmetic);

}  // namespace assay::detector
