// Exact winding numbers of a closed component, by counting the triangles that a ray crosses.
#pragma once

#include <optional>
#include <span>

#include "detector/mesh/topology.h"

namespace assay::detector {

// Winding number of the cycle formed by `triangles` around `point`; outward spheres have 1 inside.
// Nothing when the point lies on the surface. Exact; one pass over the triangles, about 30 ns each.
std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point);

// Winding number just outside `triangle` (on the side of its normal), which must touch no other
// triangle of `triangles` beyond shared vertices: the layer of the triangle is (w + 1, w).
// Nothing for a zero-area triangle. Exact; about 100 ns a triangle.
std::optional<int> winding_number_outside(const Topology& mesh,
                                          std::span<const std::int32_t> triangles,
                                          const PositionsView& x, std::int32_t triangle);

}  // namespace assay::detector
