// Chooses from where a component is viewed: from one or two fixed affine combinations of its own
// vertices. So the view primitive moves with the mesh, linearly over a step.
//
// Any place is allowed, because L3 holds for a view primitive anywhere. A good place makes V+
// large, and nothing else depends on the place.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// A point as a fixed affine combination of a few vertices around it, so that it moves with them.
struct AffineWeights {
  std::vector<std::int32_t> vertices;  // at most 54
  std::vector<double> weights;         // in the order of `vertices`; their sum is 1

  friend bool operator==(const AffineWeights&, const AffineWeights&) = default;
};

// Returns weights for the nearest vertex in each of 54 directions around the point. The weights are
// the inverses of the squared distances, corrected by the least (weighted) change that makes the
// combination equal the point. There is no correction in directions in which the vertices do not
// extend, and no correction at all if it would make the weights large. `points` holds the positions
// of `vertices`; REQUIRES coordinates of size about 1. Deterministic: + - * / only. O(n).
AffineWeights affine_weights(std::span<const std::int32_t> vertices, std::span<const Point> points,
                             const Point& point);

// Returns the combination of the vertices at positions x. Finite for finite positions, and the same
// bytes on every machine.
Point combine(const AffineWeights& affine, const PositionsView& x);

enum class ViewKind : std::uint8_t { point, line };
constexpr auto names_of(ViewKind) {
  return std::to_array<Named<ViewKind>>({{ViewKind::point, "point"}, {ViewKind::line, "line"}});
}

struct ViewAnchor {
  ViewKind kind = ViewKind::point;
  AffineWeights ends[2];  // ViewKind::point uses only the first

  friend bool operator==(const ViewAnchor&, const ViewAnchor&) = default;
};

// How many triangles are used to find a place.
enum class Effort : std::uint8_t {
  thorough,  // at most 20,000 triangles
  brief,     // at most 1,024 triangles
  quick,     // every eighth triangle, 64 to 1,000 of them
  // No triangles. A point is the mean of the vertices; a line goes from the mean halfway to one of
  // the vertices. 2 us.
  least,
};

// Returns the effort for a component: `least` for a small component of a mesh with many components,
// such as a soup of triangles; otherwise `effort`. A search takes 0.1 ms and more, however small
// the component is. For many small components this would be more time than their steps take. With
// effort_for, the searches of small components take at most 6 us a triangle more than the searches
// of large ones.
Effort effort_for(const Component& component, const Topology& mesh, Effort effort);

// Returns the best place that a search (view_search.h) finds for the component of `mesh`, ghosts
// included, at these positions. A place of winding number 1 is preferred if it makes at most 5 %
// fewer triangles positive than the best place. The place is a combination of vertices below
// `vertex_count` (apexes have higher numbers). Cost: hundreds of passes over at most 10,000
// triangles for a point and 2,500 for a line, and a few dozen passes over at most 20,000. This
// takes less time than two steps of Culling::bvh. If `pace` is stopped, the function soon returns
// some place.
ViewAnchor make_view_anchor(ViewKind kind, const Topology& mesh, const Component& component,
                            Eigen::Index vertex_count, const PositionsView& x,
                            Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// Returns a point or a line, whichever is better. The view test takes about eight times as long for
// a line as for a point: 60 ns a triangle against 7 ns. The difference is some 3 % of a step,
// because a step with contacts takes 1.4 us a triangle and more. So a line is chosen in two cases
// only: if a sixteenth of all triangles are positive for the line and not for the point, or if all
// triangles are positive for the line, because only then are steps free (L5).
ViewAnchor choose_view_anchor(const Topology& mesh, const Component& component,
                              Eigen::Index vertex_count, const PositionsView& x,
                              Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// Returns the view primitive over a step, computed in doubles, with the same bytes on every
// machine.
ViewPrimitive place_view(const ViewAnchor& anchor, const SteppedMesh& motion);

}  // namespace assay::detector
