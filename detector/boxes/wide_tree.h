// The bounding volume tree as a search reads it: with up to eight children a node, whose boxes lie
// side by side, so that vector instructions compare one box with all of them at once.
//
// It is made of the binary tree. A node whose triangles are of one component and at most eight
// holds these triangles; another node holds up to eight nodes below it, the largest of which were
// opened first. Each child keeps the number of its binary node, by which flags, components and
// patches are found.
//
// The boxes of a node with n children are twelve rows of n floats: the three lower bounds at t=0,
// the upper ones at t=0, and the same at t=1. Rows follow each other without gaps. So a mesh of
// many small components takes no more room than a large one, and whoever reads eight floats from a
// row may read some of the next row, or of the eight floats that follow the last one.
// Memory: 70 bytes a triangle, 55 of them boxes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "detector/boxes/box_lanes.h"
#include "detector/boxes/moving_box.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class BoundingVolumeTree;

// Box i of the rows.
inline MovingBox box_of(const BoxRows& rows, std::size_t i) {
  const auto three = [&](std::size_t row) {
    const float* const first = rows.first + row * rows.count + i;
    return FloatLanes{first[0], first[rows.count], first[2 * rows.count], 0};
  };
  return {three(0), three(3), three(6), three(9)};
}

class WideTree {
 public:
  WideTree() = default;
  // If `pace` was stopped, the tree must not be used.
  WideTree(const BoundingVolumeTree& binary, PacedStop* pace);

  static constexpr std::int32_t root = 0;
  struct Node {
    std::uint32_t first_slot;
    std::uint16_t count;  // of its children: 1 to 8
    bool holds_triangles;
  };
  std::size_t node_count() const { return nodes_.size(); }
  const Node& node(std::int32_t n) const { return nodes_[at(n)]; }
  // The binary node of a child, and the child itself: a node of this tree, or a triangle.
  std::int32_t binary(std::size_t slot) const { return slots_[slot].binary; }
  std::int32_t child(std::size_t slot) const { return slots_[slot].child; }
  // The binary node that holds the same triangles.
  std::int32_t binary_of(std::int32_t n) const { return binary_of_[at(n)]; }

  // The boxes of the last refit.
  BoxRows children(std::int32_t n) const {
    const Node& node = nodes_[at(n)];
    return {boxes_.get() + box_lanes::rows * node.first_slot, node.count};
  }
  const float* box(std::int32_t n) const { return own_.get() + box_lanes::rows * at(n); }

  // Makes the boxes those of the triangles, each grown by this on all sides. False if `pace` was
  // stopped.
  bool refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by, PacedStop& pace);

 private:
  struct Slot {
    std::int32_t binary, child;
  };
  struct Builder;
  void refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                  FloatLanes by);

  // Parents come before their children.
  std::vector<Node> nodes_;
  std::vector<std::int32_t> binary_of_;  // by node
  std::vector<Slot> slots_;
  std::unique_ptr<float[]> boxes_, own_;  // the first refit writes them
  std::vector<std::int32_t> inner_;       // the nodes that hold nodes, ascending
};

}  // namespace assay::detector
