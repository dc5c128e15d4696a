#include "detector/boundary/hole_tree.h"

namespace assay::detector {

HoleTree::HoleTree(const Topology& all, std::span<const std::int32_t> ghosts, const FloatGrid& grid,
                   const SteppedMesh& motion)
    : ghosts_(ghosts), boxes_(2 * ghosts.size() - 1) {
  const std::size_t first_leaf = ghosts.size() - 1;
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const auto& v = all.triangles[static_cast<std::size_t>(ghosts[i])];
    boxes_[first_leaf + i] = box_of(grid(motion, v[0]), grid(motion, v[1]), grid(motion, v[2]));
  }
  for (std::size_t n = first_leaf; n-- > 0;) {
    boxes_[n] = join(boxes_[child(n)], boxes_[child(n) + 1]);
  }
}

std::vector<HoleTree> make_hole_trees(const Topology& all, std::span<const std::int32_t> ghosts,
                                      const FloatGrid& grid, const SteppedMesh& motion) {
  const auto apex = [&](std::size_t i) {
    return all.triangles[static_cast<std::size_t>(ghosts[i])][2];
  };
  std::vector<HoleTree> trees;
  for (std::size_t begin = 0, end = 0; begin < ghosts.size(); begin = end) {
    while (end < ghosts.size() && apex(end) == apex(begin)) ++end;
    trees.emplace_back(all, ghosts.subspan(begin, end - begin), grid, motion);
  }
  return trees;
}

}  // namespace assay::detector
