// Finds the sheets of a mesh at rest: sets of triangles that are proved to be in no contact with
// each other, by the contour of the set.
//
// Where a mesh is smooth, nearly all candidates are pairs within a sheet. A search skips a pair of
// nodes if all their triangles are in one sheet. So a smooth mesh is searched only where its sheets
// end.
//
// **L13** *for sheets. Let S be a set of triangles that are seen from one side along an axis. Let
// the contour of S be the edges that the triangles of S pass once in one direction and never in the
// other. In the projection along the axis let no two edges of the contour meet except at a common
// vertex, and let no triangle of S lie beside an edge of the contour on the outer side of that
// edge. Then no two triangles of S are in contact.*
//
// Proof. For almost every point of the plane, the number of projected triangles of S that contain
// the point is the winding number of the contour around it. This number changes only at the
// contour, by one, and it is 0 or 1 on both sides of each edge of the contour. Every bounded region
// of the plane has some edge of the contour at its border, so the number is 0 or 1 everywhere: no
// two projected triangles overlap. Now let a point of one triangle of S and a point of another be
// projected to the same place.
//   Suppose that the first point is inside its triangle, or inside an edge that two triangles of S
//   share, or at a vertex that is not on the contour. Then the triangles of S around this point
//   cover all places nearby. The other triangle covers some of these places, so it is one of the
//   triangles around the first point. Its projection is one to one, so the two points are the same
//   point, in a feature that both triangles have.
//   Otherwise both points are on the contour: on the same edge of it, or on two edges that meet,
//   and these meet only at a common vertex. Again the two points are the same point, in a feature
//   that both triangles have.
// So faces, edges and vertices of S that share no vertex do not meet.
//
// The number beside an edge of the contour is counted just below the edge, a little to the right of
// its left end. Each edge of the contour that passes below this place adds one if it runs right,
// and subtracts one if it runs left. The number has to be 0 below an edge that runs right, and 1
// below an edge that runs left. Vertical edges pass below no place and need no check, because each
// bounded region has other edges at its border.
//
// sure_side says from which side a triangle is seen: if doubles cannot tell, nothing is proved.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class Sheets {
 public:
  // Looks for sheets in the whole mesh, then among the triangles of each child of the root of the
  // tree, then among the triangles of each child of these. In each of these regions there are six
  // sheets, one for each direction along each axis. 25 ns a triangle, if the whole mesh has sheets.
  // If `pace` was stopped, this object must not be used. Memory: 5 bytes a triangle.
  Sheets(const Topology& mesh, const WideTree& tree, const PositionsView& x, PacedStop* pace);

  // Returns whether nearly every triangle is in a sheet.
  bool hold_most() const { return hold_most_; }
  // Returns whether two triangles are in the same sheet.
  bool are_apart(std::int32_t a, std::int32_t b) const {
    return common(of_triangle_[at(a)], of_triangle_[at(b)]) >= sheets_bit;
  }
  // Returns whether all triangles below two nodes of the tree are in the same sheet.
  bool nodes_are_apart(std::int32_t a, std::int32_t b) const {
    return common(of_node_[at(a)], of_node_[at(b)]) >= sheets_bit;
  }

 private:
  // The sheets that contain a triangle, or all triangles of a node. The lowest six bits name the
  // region: the upper three of them the child of the root, the lower three the child of that child.
  // The next three groups of six bits are the sheets of the whole mesh, of the child of the root,
  // and of the child of that child.
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
