#include "detector/search/pair_search.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

bool search_pairs(const BoundingVolumeTree& tree, const Marks& marks, PairRule rule,
                  SearchCounts& counts, const PairSink& sink) {
  struct NodePair {
    std::int32_t a, b;
  };
  const auto may_hold = [&](const NodePair& p) {
    const auto a = marks.node_component[at(p.a)], b = marks.node_component[at(p.b)];
    const auto a_flags = marks.node_flags[at(p.a)], b_flags = marks.node_flags[at(p.b)];
    if (a == mixed_components || b == mixed_components) {
      // Such nodes may hold pairs of one component and pairs of two.
      return may_hold_pair(rule, a_flags, b_flags, true) ||
             may_hold_pair(rule, a_flags, b_flags, false);
    }
    return may_hold_pair(rule, a_flags, b_flags, a == b);
  };
  std::vector<NodePair> stack = {{0, 0}};
  while (!stack.empty()) {
    const NodePair p = stack.back();
    stack.pop_back();
    if (!may_hold(p)) continue;
    if (p.a == p.b) {
      if (tree.is_leaf(p.a)) continue;
      const auto l = tree.left(p.a), r = tree.right(p.a);
      stack.push_back({l, r});
      stack.push_back({r, r});
      stack.push_back({l, l});
      continue;
    }
    ++counts.box_tests;
    if (!tree.box(p.a).meets(tree.box(p.b))) continue;
    const bool a_leaf = tree.is_leaf(p.a), b_leaf = tree.is_leaf(p.b);
    if (a_leaf && b_leaf) {
      ++counts.candidate_pairs;
      if (!sink(tree.triangle(p.a), tree.triangle(p.b))) return false;
      continue;
    }
    const std::int32_t a_children[2] = {a_leaf ? p.a : tree.right(p.a),
                                        a_leaf ? -1 : tree.left(p.a)};
    const std::int32_t b_children[2] = {b_leaf ? p.b : tree.right(p.b),
                                        b_leaf ? -1 : tree.left(p.b)};
    for (const auto a : a_children) {
      for (const auto b : b_children) {
        if (a >= 0 && b >= 0) stack.push_back({a, b});
      }
    }
  }
  return true;
}

bool enumerate_pairs(const Topology& mesh, const Marks& marks, PairRule rule, SearchCounts& counts,
                     const PairSink& sink) {
  const auto n = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      const bool same_component =
          mesh.component_of_triangle[at(a)] == mesh.component_of_triangle[at(b)];
      if (!may_hold_pair(rule, marks.triangle_flags[at(a)], marks.triangle_flags[at(b)],
                         same_component)) {
        continue;
      }
      ++counts.candidate_pairs;
      if (!sink(a, b)) return false;
    }
  }
  return true;
}

}  // namespace assay::detector
