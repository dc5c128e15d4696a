// The one BVH over triangles: built once for a topology, refitted to every step that searches.
//
// Nodes are numbered so that the two children of a node follow each other (2k+1, 2k+2) and come
// after it, and that all nodes below a node follow each other too: a search reads both children
// from neighbouring cache lines, and a refit is a backward pass over one subtree after the other.
// Components are split first: below the first few nodes a node holds one component only.
// Memory: 158 bytes a triangle, 128 of them boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/parallel/for_all.h"
#include "detector/search/moving_box.h"

namespace assay::detector {

inline constexpr std::int32_t mixed_components = -1;

class BoundingVolumeTree {
 public:
  // Splits components, then triangles, at the median of their centres along the longest side of
  // those. A leaf holds one triangle. O(M log M).
  // Where `pace` is stopped the tree is of no use.
  BoundingVolumeTree(const Topology& mesh, const PositionsView& x, PacedStop* pace = nullptr);

  static constexpr std::int32_t root = 0;
  std::size_t node_count() const { return child_.size(); }
  bool is_leaf(std::int32_t node) const { return child_[at(node)] < 0; }
  std::int32_t triangle(std::int32_t leaf) const { return ~child_[at(leaf)]; }
  std::int32_t leaf_of(std::int32_t triangle) const { return leaf_[at(triangle)]; }
  // The first child; the second is the next node.
  std::int32_t child(std::int32_t node) const { return child_[at(node)]; }
  std::int32_t parent(std::int32_t node) const { return parent_[at((node - 1) / 2)]; }
  // The component of all triangles below, or mixed_components.
  std::int32_t component(std::int32_t node) const { return component_[at(node)]; }
  // The node above all triangles of a component, and no others.
  std::int32_t root_of(std::int32_t component) const { return component_root_[at(component)]; }

  // body(node), children before their parents and otherwise in any order, each so much work: the
  // workers of the pace take a subtree each, what is above these comes last. False when stopped.
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

  const FloatGrid& grid() const { return points_.grid(); }
  // Of the step of the last refit.
  const MovingBox& box(std::int32_t node) const { return boxes_[at(node)]; }
  // A box to compare with these; corners are rows of the two views.
  MovingBox box_of_triangle(const std::array<std::int32_t, 3>& corners, const PositionsView& x_t0,
                            const PositionsView& x_t1) const;

  // Boxes of the triangles as they move. O(M): a pass over the nodes from the last to the first.
  void refit(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1);
  // The same; false where `pace` was stopped: then some boxes are those of another step.
  bool refit(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
             PacedStop& pace);

 private:
  struct Builder;
  // A subtree of at most nodes_of_block nodes: its top, and below it the nodes first .. last - 1.
  struct Block {
    std::int32_t top, first, last;
  };
  static constexpr std::int32_t nodes_of_block = 2048;
  void make_blocks();

  std::vector<std::int32_t> child_;   // of a leaf: ~triangle
  std::vector<std::int32_t> parent_;  // by pair of siblings
  std::vector<std::int32_t> leaf_;    // by triangle
  std::vector<std::int32_t> component_;
  std::vector<std::int32_t> component_root_;  // by component
  std::vector<MovingBox> boxes_;
  RoundedPositions points_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> above_blocks_;  // the nodes in no block, ascending
};

}  // namespace assay::detector
