// Where a component is viewed from: a fixed affine combination of its own vertices, so that the
// view primitive moves with the mesh, linearly over a step.
//
// The primitive may be anywhere (L3 holds wherever it is); a good place only makes V+ large.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

enum class ViewKind : std::uint8_t { point, line };

struct ViewAnchor {
  ViewKind kind = ViewKind::point;
  std::vector<std::int32_t> vertices;           // of the component
  std::vector<std::int32_t> outer_vertices[2];  // line: of its two ends
};

// point: the mean of all vertices. line: the means of the two outer thirds of the vertices in the
// order along the longest principal axis at these positions, each pulled a quarter of the way to
// the mean of all (on small convex meshes the mean of a few vertices lies on the surface).
// O(n log n).
ViewAnchor make_view_anchor(ViewKind kind, const Component& component, const PositionsView& x);

// Means in double, summed in ascending order of vertices: the same bytes on every machine.
ViewPrimitive place_view(const ViewAnchor& anchor, const PositionsView& x_t0,
                         const PositionsView& x_t1);

}  // namespace assay::detector
