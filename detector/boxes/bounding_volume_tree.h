// The bounding volume tree over the triangles of a mesh. It is built once for a topology, and
// fitted to every step that searches. Fitting sets the boxes of its wide form (WideTree), which
// most searches read. The boxes of the binary nodes are joined from these when a step needs them.
//
// Nodes are numbered so that the two children of a node come after it and are neighbours (2k+1 and
// 2k+2 for some k), and so that all nodes below a node have consecutive numbers. A search
// therefore reads both children from neighbouring cache lines, and boxes are joined by a backward
// pass over one subtree after the other. Components are split from each other before their
// triangles are, so only the topmost nodes hold triangles of several components. Memory: 92 bytes a
// triangle, 70 of them the wide form; 128 more once the boxes of binary nodes are joined.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/boxes/box_lanes.h"
#include "detector/boxes/moving_box.h"
#include "detector/mesh/for_all.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class BoundingVolumeTree;

// Returns box i of the rows.
inline MovingBox box_of(const BoxRows& rows, std::size_t i) {
  const auto three = [&](std::size_t row) {
    const float* const first = rows.first + row * rows.count + i;
    return FloatLanes{first[0], first[rows.count], first[2 * rows.count], 0};
  };
  return {three(0), three(3), three(rows.end), three(rows.end + 3)};
}

// The bounding volume tree as a search reads it: with up to eight children a node, whose boxes lie
// side by side, so that vector instructions compare one box with all of them at once.
//
// It is made of the binary tree. A node holds its triangles if they are at most eight, all of one
// component. Any other node holds up to eight nodes below it; these are found by opening the
// largest one again and again. Each child keeps the number of its binary node, by which flags,
// components and patches are found.
//
// The boxes of a node with n children are twelve rows of n floats: the three lower bounds at t=0,
// the upper ones at t=0, and the same at t=1, unless the mesh is at rest. Rows follow each other
// without gaps. So a mesh of many small components takes no more room than one large component.
// Code that reads eight floats from a row may read some of the next row, or of the eight floats
// after the last row.
// Memory: 70 bytes a triangle, 55 of them boxes.
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
  // Return the child in a slot: as a node of the binary tree; as a node here, or a triangle.
  std::int32_t binary(std::size_t slot) const { return slots_[slot].binary; }
  std::int32_t child(std::size_t slot) const { return slots_[slot].child; }
  // Returns the binary node that holds the same triangles.
  std::int32_t binary_of(std::int32_t n) const { return binary_of_[at(n)]; }

  // Returns the boxes of the last refit.
  BoxRows children(std::int32_t n) const {
    const Node& node = nodes_[at(n)];
    return {boxes_.data() + rows() * node.first_slot, node.count, end_};
  }
  const float* box(std::int32_t n) const { return own_.data() + rows() * at(n); }

  // Allocates memory for the boxes. A mesh that is looked at only at rest takes half as much.
  void make_room(bool at_rest);
  // Fits the boxes to the triangles, each grown by `by` on all sides. Returns false if `pace` was
  // stopped. REQUIRES room for a motion like that of the points.
  bool refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by, PacedStop& pace);

 private:
  struct Slot {
    std::int32_t binary, child;
  };
  struct Builder;
  std::size_t rows() const { return end_ + box_lanes::rows / 2; }
  void refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                  FloatLanes by);

  // Parents come before their children.
  std::vector<Node> nodes_;
  std::vector<std::int32_t> binary_of_;  // by node
  LargeArray<Slot> slots_;
  LargeArray<float> boxes_, own_;    // the first refit writes them
  std::size_t end_ = 0;              // the first row of a box's bounds at t=1 (BoxRows)
  std::vector<std::int32_t> inner_;  // the nodes that hold nodes, ascending
};

// The component of a node that holds triangles of several components.
inline constexpr std::int32_t mixed_components = -1;

class BoundingVolumeTree {
 public:
  // Splits the components, then the triangles of each, at the median of their centres along the
  // longest side of the box of these centres. A component of more than 65,000 triangles is first
  // cut at the medians of a sample, so its largest nodes have halves that are not quite equal; then
  // nodes of up to 8 triangles are split in any way.
  // Centres of triangles are rounded to 2^-26 of their component. A leaf holds one triangle. O(M
  // log M). If `pace` was stopped, the tree must not be used.
  BoundingVolumeTree(const Topology& mesh, const PositionsView& x, PacedStop* pace = nullptr);

  static constexpr std::int32_t root = 0;
  std::size_t node_count() const { return child_.size(); }
  bool is_leaf(std::int32_t node) const { return child_[at(node)] < 0; }
  std::int32_t triangle(std::int32_t leaf) const { return ~child_[at(leaf)]; }
  std::int32_t leaf_of(std::int32_t triangle) const { return leaf_[at(triangle)]; }
  // Returns the first child; the second is the next node.
  std::int32_t child(std::int32_t node) const { return child_[at(node)]; }
  std::int32_t parent(std::int32_t node) const { return parent_[at((node - 1) / 2)]; }
  // Returns the component of all triangles below the node, or mixed_components.
  std::int32_t component(std::int32_t node) const {
    return component_.empty() ? 0 : component_[at(node)];
  }
  // Returns the node that holds all triangles of the component, and no others.
  std::int32_t root_of(std::int32_t component) const { return component_root_[at(component)]; }

  // Calls body(node) for each node: for children before their parents, otherwise in any order. The
  // workers of the pace share out subtrees; then one thread does the nodes above these. A call
  // costs `work_of_node` (paced_stop.h). Returns false if the pace was stopped.
  template <class Body>
  bool for_each_upward(std::uint64_t work_of_node, PacedStop* pace, Body body) const {
    const auto below = [&](std::size_t block) {
      const auto [top, first, last] = blocks_[block];
      for (auto node = last; node-- > first;) body(node);
      body(top);
    };
    const auto run = [&](std::size_t begin, std::size_t end, std::size_t) {
      for (; begin < end; ++begin) below(begin);
    };
    if (!for_all_pieces(blocks_.size(), 1, nodes_of_block * work_of_node, pace, run)) return false;
    const std::size_t last = above_blocks_.size() - 1;
    return for_each_paced(above_blocks_.size(), work_of_node, pace,
                          [&](std::size_t i) { body(above_blocks_[last - i]); });
  }

  // Returns the same tree as a search reads it, with boxes of the last refit.
  const WideTree& wide() const { return wide_; }

  const FloatGrid& grid() const { return grid_; }
  // Returns the box over the step of the last refit. REQUIRES join_boxes() since then.
  const MovingBox& box(std::int32_t node) const {
    assert(boxes_are_joined_);
    return boxes_[at(node)];
  }
  // Joins the boxes of all nodes from those of the wide tree, unless that was done since the last
  // refit. Only steps that sweep ghosts or prove patches apart need these boxes. One thread calls
  // this before several threads ask for boxes. O(M). Returns false if `pace` was stopped.
  bool join_boxes(PacedStop* pace) const;
  // Returns the box of any triangle, a ghost for example. It is on the grid of the nodes' boxes, so
  // it can be compared with them. Corners are rows of the two views.
  MovingBox box_of_triangle(const std::array<std::int32_t, 3>& corners,
                            const SteppedMesh& motion) const;

  // Grows boxes from the next refit on, so that the boxes of triangles that come within `distance`
  // of each other are not apart.
  void grow_boxes(double distance) {
    separation_ = distance;
    forget_fit();
  }
  double grown_by() const { return separation_; }
  // Fits the boxes to the triangles as they move over the step. O(M): one pass over the nodes from
  // the last to the first.
  void refit(const Topology& mesh, const SteppedMesh& motion);
  // Does the same. Returns false if `pace` was stopped; some boxes are then those of another step.
  // The boxes are grown as if `slack` were added to the distance. With a slack, no later fit_once
  // reuses them.
  bool refit(const Topology& mesh, const SteppedMesh& motion, PacedStop& pace, double slack = 0);
  // Refits the boxes, unless they were last fitted to the same arrays of positions. So the stages
  // of a step that search the same motion fit the boxes once. REQUIRES that positions in these
  // arrays have not changed since forget_fit().
  bool fit_once(const Topology& mesh, const SteppedMesh& motion, PacedStop& pace);
  void forget_fit() { fitted_to_.reset(); }

 private:
  struct Builder;
  // Where the positions of a motion lie. Strides are compared too, because two views may begin at
  // the same address.
  struct Arrays {
    explicit Arrays(const SteppedMesh& motion)
        : t0(motion.vertices_t0.data()),
          t1(motion.vertices_t1.data()),
          stride_t0(motion.vertices_t0.outerStride()),
          stride_t1(motion.vertices_t1.outerStride()),
          rows(motion.size()) {}
    friend bool operator==(const Arrays&, const Arrays&) = default;
    const double *t0, *t1;
    Eigen::Index stride_t0, stride_t1, rows;
  };
  // A subtree of at most nodes_of_block nodes: its top, and below it the nodes first .. last - 1.
  struct Block {
    std::int32_t top, first, last;
  };
  static constexpr std::int32_t nodes_of_block = 2048;
  void make_blocks();

  LargeArray<std::int32_t> child_;            // the first child of a node; for a leaf ~triangle
  LargeArray<std::int32_t> parent_;           // by pair of siblings
  LargeArray<std::int32_t> leaf_;             // by triangle
  std::vector<std::int32_t> component_;       // by node; empty if there is one component
  std::vector<std::int32_t> component_root_;  // by component
  mutable LargeArray<MovingBox> boxes_;       // by node; nothing until they are first joined
  mutable bool boxes_are_joined_ = false;
  WideTree wide_;
  double separation_ = 0;
  std::optional<Arrays> fitted_to_;
  FloatGrid grid_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> above_blocks_;  // the nodes in no block, ascending
};

}  // namespace assay::detector
