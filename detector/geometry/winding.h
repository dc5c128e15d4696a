// Winding numbers of a closed component, by counting the triangles that a ray crosses.
//
// In exact arithmetic the numbers are exact. In bounded arithmetic every number returned is right,
// and nullopt is returned if doubles cannot tell. Plain doubles and floats promise nothing.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Returns the winding number around `point` of the cycle that `triangles` form. It is 1 inside a
// sphere whose normals point outward. Returns nullopt if the point lies on the surface, or if
// `pace` was stopped. Cost: about 10 ns a triangle for each ray tried. If a ray meets an edge or a
// corner, the next ray is tried; nearly always the first ray is enough.
std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point,
                                  Arithmetic arithmetic = Arithmetic::exact,
                                  PacedStop* pace = nullptr);

// Returns, for each triangle of `queries`, the winding number w just beside it, on the side of its
// normal. The layer of that triangle is (w + 1, w). REQUIRES that no triangle of `queries` touches
// another triangle of `triangles` beyond shared vertices. The result is nullopt for a triangle of
// zero area, and for triangles that were not reached before `pace` was stopped. All numbers
// together cost about as much as two calls of winding_number (half of the rays point the wrong way
// at the first try), plus 50 ns for each pair of a ray and a triangle whose projections along the
// ray meet.
std::vector<std::optional<int>> winding_numbers_outside(const Topology& mesh,
                                                        std::span<const std::int32_t> triangles,
                                                        const PositionsView& x,
                                                        std::span<const std::int32_t> queries,
                                                        Arithmetic arithmetic = Arithmetic::exact,
                                                        PacedStop* pace = nullptr);

// Returns whether the triangle is a point or a segment at the positions x. Exact.
bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

// Returns whether two corners of the triangle are the same point at the positions x. Then the
// triangle has zero area, and no arithmetic is needed to know it.
bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

// The signs of determinants tell how a ray crosses a triangle.
//
// Let A, B, C be the corners minus the ray's origin, and r the ray's direction. The ray's line
// crosses the inside of the triangle if and only if det(A,B,r), det(B,C,r) and det(C,A,r) have one
// strict sign. That sign is then the sign of r . normal, because r . normal is their sum. The
// crossing is ahead of the origin if det(A,B,C) has that sign too.

using RayOrigin = std::array<Point, 3>;  // stands for the point (2 o[0] + o[1] + o[2]) / 4
using RayDirection = std::array<int, 3>;

// The signs of det(A,B,r), det(B,C,r), det(C,A,r), det(A,B,C), in this order.
using CrossingSigns = std::array<int, 4>;

// Returns the signs. Exact arithmetic gives the true signs. Bounded arithmetic gives 0 for a sign
// that doubles cannot tell. Plain doubles and floats give the signs as computed. About 30 ns if
// doubles can tell.
CrossingSigns crossing_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r, Arithmetic arithmetic);

}  // namespace assay::detector
