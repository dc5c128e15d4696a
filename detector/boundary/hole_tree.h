// A small tree for each hole, over the ghosts of its fan as they move.
//
// The leaves have the order of the fan along its loop, so nothing needs to be sorted. Node n has
// the children 2n+1 and 2n+2; the last nodes are the leaves.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/surface.h"
#include "detector/search/moving_box.h"

namespace assay::detector {

class HoleTree {
 public:
  // REQUIRES the ghosts of one loop in its order, at least one. Their corners are vertices of
  // `motion`. The boxes may be compared with others of the same grid. 50 ns a ghost.
  HoleTree(const Topology& all, std::span<const std::int32_t> ghosts, const FloatGrid& grid,
           const SteppedMesh& motion);

  static constexpr std::size_t root = 0;
  bool is_leaf(std::size_t node) const { return node + 1 >= ghosts_.size(); }
  std::size_t child(std::size_t node) const { return 2 * node + 1; }  // the other is the next
  std::int32_t first_ghost() const { return ghosts_.front(); }
  std::int32_t ghost(std::size_t leaf) const { return ghosts_[leaf + 1 - ghosts_.size()]; }
  const MovingBox& box(std::size_t node) const { return boxes_[node]; }

  // Calls visit(ghost) for the ghosts whose box is not apart from `box`, until it returns true.
  // Returns whether it did.
  template <class Visit>
  bool any_near(const MovingBox& box, Visit visit) const {
    return any_near(root, box, visit);
  }

 private:
  template <class Visit>
  bool any_near(std::size_t node, const MovingBox& box, Visit& visit) const {
    if (apart(boxes_[node], box)) return false;
    if (is_leaf(node)) return visit(ghost(node));
    return any_near(child(node), box, visit) || any_near(child(node) + 1, box, visit);
  }

  std::span<const std::int32_t> ghosts_;
  std::vector<MovingBox> boxes_;
};

// A tree for each hole of a component, whose ghosts are given.
std::vector<HoleTree> make_hole_trees(const Topology& all, std::span<const std::int32_t> ghosts,
                                      const FloatGrid& grid, const SteppedMesh& motion);

}  // namespace assay::detector
