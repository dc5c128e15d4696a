// The bounding volume tree over the triangles of a mesh. The tree is built once for a topology, and
// its boxes are fitted to each step in which pairs are searched. Fitting sets the boxes of the wide
// form of the tree (WideTree), which most searches read. The boxes of the binary nodes are joined
// from the boxes of the wide form, if a step needs them.
//
// Nodes are numbered so that the two children of a node come after it and are neighbours (2k+1 and
// 2k+2 for some k), and so that all nodes below a node have consecutive numbers. A search therefore
// reads both children from neighbouring cache lines, and one backward pass over a subtree joins its
// boxes. Components are split from each other before the triangles of a component are split, so
// only the topmost nodes hold triangles of several components. Memory: 92 bytes a triangle, 70 of
// them for the wide form; 128 more once the boxes of binary nodes are joined.
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

// The bounding volume tree in the form that searches read: a node has up to eight children. The
// boxes of the children lie side by side, so that vector instructions compare all of them with
// another box at once.
//
// It is made from the binary tree. The children of a node are triangles if the node has at most
// eight triangles, all of one component. Otherwise they are up to eight nodes: beginning with the
// node itself, the largest one is replaced by its two binary children again and again. Each child
// has the number of its binary node, which is the index into flags, components and patches.
//
// The boxes of a node with n children are twelve rows of n floats: three rows of lower bounds at
// t=0, three of upper bounds at t=0, and six rows of bounds at t=1. If the mesh is at rest, the
// last six rows are left out. Rows follow each other without gaps. So a mesh of many small
// components takes no more room than one large component. Code that reads eight floats from a row
// of fewer floats also reads floats of the next row; eight unused floats follow the last row.
// Memory: 70 bytes a triangle, 55 of them boxes.
class WideTree {
 public:
  WideTree() = default;
  // If `pace` was stopped, the tree must not be used.
  WideTree(const BoundingVolumeTree& binary, PacedStop* pace);

  static constexpr std::int32_t root = 0;
  struct Node {
    std::uint32_t first_slot;
    std::uint16_t count;  // the number of children: 1 to 8
    bool holds_triangles;
  };
  std::size_t node_count() const { return nodes_.size(); }
  const Node& node(std::int32_t n) const { return nodes_[at(n)]; }
  // Return the child in a slot: `binary` returns its binary node; `child` returns its node in this
  // tree or, if the parent holds triangles, the triangle.
  std::int32_t binary(std::size_t slot) const { return slots_[slot].binary; }
  std::int32_t child(std::size_t slot) const { return slots_[slot].child; }
  // Returns the binary node that holds the same triangles.
  std::int32_t binary_of(std::int32_t n) const { return binary_of_[at(n)]; }

  // Returns the boxes of the children of a node, as the last refit has set them.
  BoxRows children(std::int32_t n) const {
    const Node& node = nodes_[at(n)];
    return {boxes_.data() + rows() * node.first_slot, node.count, end_};
  }
  const float* box(std::int32_t n) const { return own_.data() + rows() * at(n); }

  // Allocates memory for the boxes: half as much if at_rest, for a mesh that never moves.
  void make_room(bool at_rest);
  // Fits the boxes to the triangles, and grows each box by `by` on all sides. Returns false if
  // `pace` was stopped. REQUIRES an earlier call of make_room; if that call had at_rest, the points
  // must be at rest.
  bool refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by, PacedStop& pace);

 private:
  struct Slot {
    std::int32_t binary, child;
  };
  struct Builder;
  std::size_t rows() const { return end_ + box_lanes::rows / 2; }
  void refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                  FloatLanes by);

  // Parents come before their children, and the nodes below a node have consecutive numbers.
  std::vector<Node> nodes_;
  std::vector<std::int32_t> binary_of_;  // by node
  LargeArray<Slot> slots_;
  LargeArray<float> boxes_, own_;    // the first refit writes them
  std::size_t end_ = 0;              // the first row of a box's bounds at t=1 (BoxRows)
  std::vector<std::int32_t> inner_;  // the nodes whose children are nodes, ascending
};

// What component() returns for a node that holds triangles of several components.
inline constexpr std::int32_t mixed_components = -1;

class BoundingVolumeTree {
 public:
  // Splits the set of components, and then the triangles of each component, in halves: at the
  // median of the centres, along the longest side of the box around the centres. In a component of
  // more than 65,000 triangles, the largest nodes are split at the medians of a sample, so their
  // halves are not quite equal, and nodes of up to 8 triangles are split in any way.
  // Centres of triangles are rounded to 2^-26 of the size of their component. A leaf holds one
  // triangle. O(M log M). If `pace` was stopped, the tree must not be used.
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

  // Calls body(node) for each node: for children before their parents, otherwise in any order.
  // First the workers of the pace share the subtrees; then one thread does the nodes above the
  // subtrees. Each call counts as work_of_node units of work (paced_stop.h). Returns false if
  // the pace was stopped.
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

  // Returns the wide form of this tree, with the boxes that the last refit has set.
  const WideTree& wide() const { return wide_; }

  const FloatGrid& grid() const { return grid_; }
  // Returns the box of a node over the step of the last refit. REQUIRES a call of join_boxes()
  // since the last refit.
  const MovingBox& box(std::int32_t node) const {
    assert(boxes_are_joined_);
    return boxes_[at(node)];
  }
  // Joins the boxes of all nodes from the boxes of the wide tree, unless this was done since the
  // last refit. Only steps that sweep ghosts or prove patches apart need these boxes. REQUIRES that
  // one thread calls this before several threads call box(). O(M). Returns false if `pace` was
  // stopped.
  bool join_boxes(PacedStop* pace) const;
  // Returns the box of any triangle, for example of a ghost. It is rounded by grid() like the boxes
  // of nodes, so it can be compared with them. `corners` are vertices of `motion`.
  MovingBox box_of_triangle(const std::array<std::int32_t, 3>& corners,
                            const SteppedMesh& motion) const;

  // Grows boxes from the next refit on, so that the boxes of triangles that come within `distance`
  // of each other are not apart.
  void grow_boxes(double distance) {
    separation_ = distance;
    forget_fit();
  }
  double grown_by() const { return separation_; }
  // Fits the boxes to the triangles as they move over the step. O(M).
  void refit(const Topology& mesh, const SteppedMesh& motion);
  // Does the same, and grows the boxes as if `slack` were added to the distance. Returns false if
  // `pace` was stopped; then some boxes are still fitted to another step. Boxes with a slack are
  // not reused by a later fit_once.
  bool refit(const Topology& mesh, const SteppedMesh& motion, PacedStop& pace, double slack = 0);
  // Refits the boxes, unless they were last fitted to the same arrays of positions. So the stages
  // of a step that search the same motion fit the boxes once. REQUIRES that the positions in these
  // arrays have not changed since the last call of forget_fit().
  bool fit_once(const Topology& mesh, const SteppedMesh& motion, PacedStop& pace);
  void forget_fit() { fitted_to_.reset(); }

 private:
  struct Builder;
  // Says in which arrays the positions of a motion are. Strides are compared too, because two
  // different views can begin at the same address.
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

  LargeArray<std::int32_t> child_;            // by node: its first child, or ~triangle of a leaf
  LargeArray<std::int32_t> parent_;           // by pair of siblings
  LargeArray<std::int32_t> leaf_;             // by triangle
  std::vector<std::int32_t> component_;       // by node; empty if there is one component
  std::vector<std::int32_t> component_root_;  // by component
  mutable LargeArray<MovingBox> boxes_;       // by node; empty until they are first joined
  mutable bool boxes_are_joined_ = false;
  WideTree wide_;
  double separation_ = 0;
  std::optional<Arrays> fitted_to_;
  FloatGrid grid_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> above_blocks_;  // the nodes in no block, ascending
};

}  // namespace assay::detector
