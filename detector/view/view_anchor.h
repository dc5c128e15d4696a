// Where a component is viewed from: one or two fixed affine combinations of its own vertices, so
// that the view primitive moves with the mesh, linearly over a step.
//
// The primitive may be anywhere (L3 holds wherever it is); a good place only makes V+ large.
#pragma once

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/view/affine_weights.h"

namespace assay::detector {

enum class ViewKind : std::uint8_t { point, line };

struct ViewAnchor {
  ViewKind kind = ViewKind::point;
  AffineWeights ends[2];  // point: the first
};

// How much is looked at to find a place.
enum class Effort : std::uint8_t {
  thorough,  // at most 20,000 triangles
  quick,     // every eighth triangle, 64 to 1,000 of them
  least,     // none: the mean of the vertices, and halfway to one of them, 2 us
};

// A search takes 0.1 ms and more, however small the component. Where components are many and small,
// as in a soup of triangles, that is more than their steps take: such are not searched for a place,
// so that the searches take at most 6 us a triangle beside what large components take. `wanted`:
// for all others.
Effort effort_for(const Component& component, const Topology& mesh, Effort wanted);

// The best place found by search (view_search.h) for the component of `mesh` (its ghosts too) at
// these positions. A point of winding number 1 is taken where one is found that costs at most 5 %
// of the triangles. Uses vertices below `vertex_count` (apexes are above). Hundreds of passes
// over at most 10,000 triangles for a point and 2,500 for a line, a few dozen over at most 20,000:
// less than two steps of culling bvh take. Some place, soon, once `pace` says to end.
ViewAnchor make_view_anchor(ViewKind kind, const Topology& mesh, const Component& component,
                            Eigen::Index vertex_count, const PositionsView& x,
                            Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// A point or a line, whichever is better. The test of a line takes about eight times as long as
// that of a point (60 ns against 7 ns a triangle, where a step with contacts takes 1.4 us and
// more), some 3 % of a step: a line is taken only where it makes a sixteenth of the triangles
// positive that the point does not, or all of them, which alone makes steps free (L5).
ViewAnchor choose_view_anchor(const Topology& mesh, const Component& component,
                              Eigen::Index vertex_count, const PositionsView& x,
                              Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// In double: the same bytes on every machine.
ViewPrimitive place_view(const ViewAnchor& anchor, const PositionsView& x_t0,
                         const PositionsView& x_t1);

}  // namespace assay::detector
