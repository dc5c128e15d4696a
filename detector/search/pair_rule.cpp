#include "detector/search/pair_rule.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

void mark_nodes(const BoundingVolumeTree& tree, const Topology& mesh, Marks& marks) {
  marks.node_flags.resize(tree.node_count());
  marks.node_component.resize(tree.node_count());
  for (std::size_t n = tree.node_count(); n-- > 0;) {
    const auto node = static_cast<std::int32_t>(n);
    if (tree.is_leaf(node)) {
      marks.node_flags[n] = marks.triangle_flags[at(tree.triangle(node))];
      marks.node_component[n] = mesh.component_of_triangle[at(tree.triangle(node))];
      continue;
    }
    const auto l = at(tree.left(node)), r = at(tree.right(node));
    marks.node_flags[n] = marks.node_flags[l] | marks.node_flags[r];
    marks.node_component[n] = marks.node_component[l] == marks.node_component[r]
                                  ? marks.node_component[l]
                                  : mixed_components;
  }
}

}  // namespace assay::detector
