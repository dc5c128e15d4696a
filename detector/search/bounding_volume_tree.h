// The one BVH over triangles: built once for a topology, refitted to every step.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::detector {

struct Box {
  double lo[3], hi[3];
  bool meets(const Box& other) const {
    return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] &&
           other.lo[1] <= hi[1] && lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
  }
};

// Of the swept triangle: exact, as it only compares inputs.
Box swept_box(const std::array<std::int32_t, 3>& vertices, const PositionsView& x_t0,
              const PositionsView& x_t1);

// Nodes in depth-first order: an inner node's left child follows it. A leaf holds one triangle.
class BoundingVolumeTree {
 public:
  // Splits the triangles at the median of their centres along the longest side of those. O(M log
  // M).
  BoundingVolumeTree(const Topology& mesh, const PositionsView& x);

  std::size_t node_count() const { return triangle_.size(); }
  bool is_leaf(std::int32_t node) const { return triangle_[static_cast<std::size_t>(node)] >= 0; }
  std::int32_t triangle(std::int32_t leaf) const {
    return triangle_[static_cast<std::size_t>(leaf)];
  }
  std::int32_t left(std::int32_t node) const { return node + 1; }
  std::int32_t right(std::int32_t node) const { return right_[static_cast<std::size_t>(node)]; }
  const Box& box(std::int32_t node) const { return boxes_[static_cast<std::size_t>(node)]; }

  // Boxes of the swept triangles. O(M).
  void refit(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1);

 private:
  std::int32_t build(std::vector<std::int32_t>& order, const std::vector<Point>& centres,
                     std::size_t begin, std::size_t end);

  std::vector<std::int32_t> triangle_;  // -1 for an inner node
  std::vector<std::int32_t> right_;
  std::vector<Box> boxes_;
};

}  // namespace assay::detector
