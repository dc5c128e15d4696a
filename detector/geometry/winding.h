// Winding numbers of a closed component, by counting the triangles that a ray crosses.
//
// In exact arithmetic the numbers are exact. In bounded arithmetic they are right where they are
// given, and there is none (nullopt) if doubles cannot tell. Plain doubles and floats promise
// nothing.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// The winding number around `point` of the cycle that `triangles` form. A sphere with its normals
// outward has 1 inside. None if the point lies on the surface, or if `pace` was stopped. Cost:
// about 10 ns a triangle for each ray tried. A ray that meets an edge or a corner is given up for
// the next one; nearly always the first ray will do.
std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point,
                                  Arithmetic arithmetic = Arithmetic::exact,
                                  PacedStop* pace = nullptr);

// The winding number w just outside each of the triangles `asked`, on the side of its normal. The
// layer of that triangle is (w + 1, w). REQUIRES that a triangle asked for touches no other
// triangle of `triangles` beyond shared vertices. None for a triangle of zero area, and none if
// `pace` was stopped. All numbers together cost about two winding numbers of points, because half
// of the rays point the wrong way at the first try, and 50 ns for each triangle whose shadow a ray
// meets.
std::vector<std::optional<int>> winding_numbers_outside(const Topology& mesh,
                                                        std::span<const std::int32_t> triangles,
                                                        const PositionsView& x,
                                                        std::span<const std::int32_t> asked,
                                                        Arithmetic arithmetic = Arithmetic::exact,
                                                        PacedStop* pace = nullptr);

// Whether the triangle is a point or a segment at x. Exact.
bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

// Whether two corners of the triangle are the same point at x. This is a case of zero area that
// can be seen without arithmetic.
bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

}  // namespace assay::detector
