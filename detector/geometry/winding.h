// Winding numbers of a closed component, by counting the triangles that a ray crosses.
//
// In exact arithmetic what is said is exact. Bounded arithmetic says nothing (nullopt, false) where
// doubles cannot tell, and never anything wrong; plain doubles and floats promise nothing.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Winding number of the cycle formed by `triangles` around `point`; outward spheres have 1 inside.
// Nothing when the point lies on the surface. About 10 ns a triangle, once for each ray tried: a
// ray that meets an edge or a corner is given up; the first one nearly always does. Nothing too
// where `pace` was stopped; so below.
std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point,
                                  Arithmetic arithmetic = Arithmetic::exact,
                                  PacedStop* pace = nullptr);

// Winding numbers just outside each of the triangles `asked` (on the side of its normal), which
// must touch no other triangle of `triangles` beyond shared vertices: the layer of the triangle is
// (w + 1, w). Nothing for a zero-area triangle. All together cost about two winding numbers of
// points (half of the rays point the wrong way at first try), and 50 ns for each triangle whose
// shadow a ray meets.
std::vector<std::optional<int>> winding_numbers_outside(const Topology& mesh,
                                                        std::span<const std::int32_t> triangles,
                                                        const PositionsView& x,
                                                        std::span<const std::int32_t> asked,
                                                        Arithmetic arithmetic = Arithmetic::exact,
                                                        PacedStop* pace = nullptr);

// Whether the triangle is a point or a segment at x. Exact.
bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

// Whether two of its corners are the same point at x: zero area that no arithmetic is needed for.
bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

}  // namespace assay::detector
