// Sheets of a mesh at rest: sets of triangles that are proved apart as a whole, by their contours.
//
// Where a mesh is smooth, nearly all candidates lie in sheets, and a search passes over pairs of
// nodes whose triangles lie in one. So a smooth mesh is searched only where its sheets end.
//
// **L13** *for sheets. Let S be a set of triangles that are seen from one side along an axis. Let
// its contour be the edges of its triangles that are passed once, and not back. In the projection
// along the axis let no two edges of the contour meet except at a common vertex, and let no
// triangle of S lie beside an edge of the contour on its outer side. Then triangles of S are in no
// contact.*
//
// Proof. For almost every point of the plane, the number of projected triangles of S that hold it
// is how often the contour winds around it. That number changes only at the contour, by one, and it
// is 0 or 1 on both sides of each edge of the contour. Every bounded region between edges has some
// of them beside it, so the number is 0 or 1 everywhere: no two projected triangles overlap. Now
// let a point of one triangle of S and a point of another be projected to one place.
//   Suppose that the first point is inside its triangle, inside an edge that two of S share, or at
//   a vertex off the contour. Then the triangles of S around it cover all places nearby. The other
//   triangle covers some of these places, so it is one of the triangles around the first point. It
//   projects one to one, so the two points are the same, in a feature that both triangles have.
//   Otherwise both points are on the contour: on one edge of it, or on two edges that meet and so
//   have a vertex in common there. Again the points are the same, in a feature that both triangles
//   have.
// So faces, edges and vertices of S that share no vertex do not meet.
//
// The number beside an edge is counted below its left end, a little to the right of it: among the
// edges of the contour that pass below, each that runs right adds one, each that runs left takes
// one away. An edge that runs right has to have the number 0 below it, an edge that runs left the
// number 1. Vertical edges pass below nothing and need no check: each bounded region has other
// edges beside it.
//
// Sides are those of sure_side: where doubles cannot tell, nothing is proved.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class Sheets {
 public:
  // Looks for sheets in the whole mesh, then in the region of each child of the root of the tree,
  // then in the regions of their children. There are six in each region, one for either side along
  // each axis. 25 ns a triangle, if the whole mesh has sheets. If `pace` was stopped, the object
  // must not be used. Memory: 5 bytes a triangle.
  Sheets(const Topology& mesh, const WideTree& tree, const PositionsView& x, PacedStop* pace);

  // Returns whether nearly all triangles lie in some sheet.
  bool hold_most() const { return hold_most_; }
  // Returns whether two triangles lie in one sheet.
  bool are_apart(std::int32_t a, std::int32_t b) const {
    return common(of_triangle_[at(a)], of_triangle_[at(b)]) >= sheets_bit;
  }
  // Returns whether all triangles below two nodes of the tree lie in one sheet.
  bool nodes_are_apart(std::int32_t a, std::int32_t b) const {
    return common(of_node_[at(a)], of_node_[at(b)]) >= sheets_bit;
  }

 private:
  // The sheets that hold a triangle, or all triangles of a node. The lowest six bits name the
  // region: the upper three the child of the root, the lower three the child of that child. Above
  // them are three groups of six bits: the sheets of the whole mesh, and those of the region at
  // either level.
  using Places = std::uint32_t;
  static constexpr int directions = 6, levels = 3, region_bits = 6, of_lower = 3;
  static constexpr Places sheets_bit = 1 << region_bits;
  static constexpr Places sheets_above(int level) { return (sheets_bit << directions * level) - 1; }
  // Returns the sheets that `a` and `b` have in common.
  static Places common(Places a, Places b) {
    const Places other = (a ^ b) & (sheets_bit - 1);
    return (a & b & sheets_above(other == 0 ? levels : other >> of_lower == 0 ? 2 : 1));
  }
  struct Builder;

  LargeArray<Places> of_triangle_, of_node_;
  bool hold_most_ = false;
};

}  // namespace assay::detector
