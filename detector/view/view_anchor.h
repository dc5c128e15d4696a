// Where a component is viewed from: one or two fixed affine combinations of its own vertices. So
// the view primitive moves with the mesh, linearly over a step.
//
// The primitive may be anywhere, because L3 holds wherever it is. A good place only makes V+
// large.
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
  std::vector<double> weights;         // by place in `vertices`; their sum is 1

  friend bool operator==(const AffineWeights&, const AffineWeights&) = default;
};

// Returns the weights of the nearest vertex in each of 54 directions around the point. They are the
// inverses of the squared distances, corrected by the least (weighted) change that makes the
// combination equal the point. There is no correction in directions in which the vertices do not
// extend, and none at all if it would make the weights large. `points` holds the positions of
// `vertices`; REQUIRES coordinates of size about 1. Deterministic: + - * / only. O(n).
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
  AffineWeights ends[2];  // a point uses the first only

  friend bool operator==(const ViewAnchor&, const ViewAnchor&) = default;
};

// How many triangles are looked at to find a place.
enum class Effort : std::uint8_t {
  thorough,  // at most 20,000 triangles
  brief,     // at most 1,024 triangles
  quick,     // every eighth triangle, 64 to 1,000 of them
  // No triangles. The place is the mean of the vertices; a line goes from there halfway to one of
  // the vertices. 2 us.
  least,
};

// Returns the effort for a component: `least` for a small component of a mesh with many components,
// such as a soup of triangles; otherwise `effort`. A search takes 0.1 ms and more, however small
// the component is. For many small components that would be more than their steps take. In this way
// the searches take at most 6 us a triangle more than those of large components.
Effort effort_for(const Component& component, const Topology& mesh, Effort effort);

// Returns the best place that a search (view_search.h) finds for the component of `mesh`, ghosts
// included, at these positions. A place of winding number 1 is preferred if it makes at most 5 %
// fewer of the triangles positive than the best one. The place is combined of vertices below
// `vertex_count` (apexes are above). Cost: hundreds of passes over at most 10,000 triangles for a
// point and 2,500 for a line, and a few dozen over at most 20,000. That is less than two steps of
// Culling::bvh take. Once `pace` says to end, it soon returns some place.
ViewAnchor make_view_anchor(ViewKind kind, const Topology& mesh, const Component& component,
                            Eigen::Index vertex_count, const PositionsView& x,
                            Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// Returns a point or a line, whichever is better. The view test of a line takes about eight times
// as long as that of a point: 60 ns against 7 ns a triangle. That is some 3 % of a step, because a
// step with contacts takes 1.4 us a triangle and more. So a line is taken only if it makes a
// sixteenth of the triangles positive that the point does not, or if it makes all of them positive,
// because only that makes steps free (L5).
ViewAnchor choose_view_anchor(const Topology& mesh, const Component& component,
                              Eigen::Index vertex_count, const PositionsView& x,
                              Effort effort = Effort::thorough, PacedStop* pace = nullptr);

// Returns the view primitive over a step. Computed in double, with the same bytes on every machine.
ViewPrimitive place_view(const ViewAnchor& anchor, const SteppedMesh& motion);

}  // namespace assay::detector
