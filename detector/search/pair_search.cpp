#include "detector/search/pair_search.h"

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

bool TreeSearch::search(const SearchInput& input, SearchCounts& counts,
                        const PairSink& sink) const {
  const BoundingVolumeTree& tree = input.tree;
  Marks& marks = input.marks;
  mark_nodes(tree, input.mesh, marks);
  struct NodePair {
    std::int32_t a, b;
  };
  const auto may_hold = [&](const NodePair& p) {
    const auto a = marks.node_component[at(p.a)], b = marks.node_component[at(p.b)];
    const auto a_flags = marks.node_flags[at(p.a)], b_flags = marks.node_flags[at(p.b)];
    if (a == mixed_components || b == mixed_components) {
      // Such nodes may hold pairs of one component and pairs of two.
      return input.tables.within.asks(a_flags, b_flags) ||
             input.tables.across.asks(a_flags, b_flags);
    }
    return (a == b ? input.tables.within : input.tables.across).asks(a_flags, b_flags);
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

bool ExhaustiveSearch::search(const SearchInput& input, SearchCounts& counts,
                              const PairSink& sink) const {
  const auto& flags = input.marks.triangle_flags;
  const auto& component = input.mesh.component_of_triangle;
  const auto n = static_cast<std::int32_t>(input.mesh.triangles.size());
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      const bool same = component[at(a)] == component[at(b)];
      const PairTable& table = same ? input.tables.within : input.tables.across;
      if (!table.asks(flags[at(a)], flags[at(b)])) continue;
      ++counts.candidate_pairs;
      if (!sink(a, b)) return false;
    }
  }
  return true;
}

bool search_box(const BoundingVolumeTree& tree, const Box& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink) {
  std::vector<std::int32_t> stack = {0};
  while (!stack.empty()) {
    const auto node = stack.back();
    stack.pop_back();
    ++counts.box_tests;
    if (!tree.box(node).meets(box)) continue;
    if (tree.is_leaf(node)) {
      ++counts.candidate_pairs;
      if (!sink(tree.triangle(node))) return false;
      continue;
    }
    stack.push_back(tree.right(node));
    stack.push_back(tree.left(node));
  }
  return true;
}

}  // namespace assay::detector
