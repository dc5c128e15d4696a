// Winding numbers of a closed component, by counting the triangles that a ray crosses.
//
// In exact arithmetic what is said is exact. Bounded arithmetic says nothing (nullopt, false) where
// doubles cannot tell, and never anything wrong; plain doubles and floats promise nothing.
#pragma once

#include <optional>
#include <span>

#include "detector/arithmetic.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Winding number of the cycle formed by `triangles` around `point`; outward spheres have 1 inside.
// Nothing when the point lies on the surface. About 30 ns a triangle, once for each ray
// tried (a ray that meets an edge or a corner is given up; the first one nearly always does).
std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point,
                                  Arithmetic arithmetic = Arithmetic::exact);

// Winding number just outside `triangle` (on the side of its normal), which must touch no other
// triangle of `triangles` beyond shared vertices: the layer of the triangle is (w + 1, w).
// Nothing for a zero-area triangle. About 100 ns a triangle and ray.
std::optional<int> winding_number_outside(const Topology& mesh,
                                          std::span<const std::int32_t> triangles,
                                          const PositionsView& x, std::int32_t triangle,
                                          Arithmetic arithmetic = Arithmetic::exact);

// Whether the triangle is a point or a segment at x. Exact.
bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

// Whether two of its corners are the same point at x: zero area that no arithmetic is needed for.
bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle);

}  // namespace assay::detector
