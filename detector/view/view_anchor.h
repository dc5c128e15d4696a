// Where a component is viewed from: a fixed affine combination of its own vertices, so that the
// view primitive moves with the mesh, linearly over a step.
//
// The primitive may be anywhere (L3 holds wherever it is); a good place only makes V+ large.
#pragma once

#include <vector>

#include "detector/mesh/topology.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

enum class ViewKind : std::uint8_t { point, line };

struct ViewAnchor {
  std::vector<std::int32_t> q0_vertices, q1_vertices;  // an end is the mean of its vertices
};

// point: the mean of all vertices. line: the means of the two outer thirds of the vertices in the
// order along the longest principal axis at these positions. O(n log n).
ViewAnchor make_view_anchor(ViewKind kind, const Component& component, const PositionsView& x);

// Means in double, summed in ascending order of vertices: the same bytes on every machine.
ViewPrimitive place_view(const ViewAnchor& anchor, const PositionsView& x_t0,
                         const PositionsView& x_t1);

}  // namespace assay::detector
