// The view test of whole components: view sets V+, V-, V0 over a step.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"
#include "detector/view/view_filter.h"

namespace assay::detector {

struct ViewCounts {
  std::uint64_t filter = 0, exact = 0;  // triangles settled by each
};

// Exact sign over the step: the filter, then integers for what it leaves open.
ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts);

// Signs of `triangles` (indices into the mesh) written to signs[triangle].
void classify(const Topology& mesh, std::span<const std::int32_t> triangles,
              const PositionsView& x_t0, const PositionsView& x_t1, const ViewPrimitive& primitive,
              std::vector<ViewSign>& signs, ViewCounts& counts);

// Whether all of `triangles` are positive at one instant. Stops at the first that is not.
bool all_positive_at(const Topology& mesh, std::span<const std::int32_t> triangles,
                     const PositionsView& x, const Point& q0, const Point& q1);

}  // namespace assay::detector
