#include "detector/search/pair_search.h"

namespace assay::detector {
namespace {

class Descent {
 public:
  Descent(const SearchInput& input, bool skips, PatchProofs* proofs, SearchCounts& counts,
          const PairSink& sink)
      : tree_(input.tree),
        flags_(input.marks.node_flags.data()),
        within_(input.tables.within),
        across_(input.tables.across),
        either_(within_.joined_with(across_)),
        skips_(skips),
        proofs_(proofs),
        counts_(counts),
        sink_(sink) {}

  // False when the sink stopped it.
  bool run() {
    below_mixed(BoundingVolumeTree::root, BoundingVolumeTree::root);
    return !stopped_ && !(proofs_ && proofs_->is_stopped());
  }

 private:
  struct NodePair {
    std::int32_t a, b;
  };

  std::uint8_t flags(std::int32_t node) const { return flags_[at(node)]; }

  // Nodes above the components, and pairs of which one is such a node.
  void below_mixed(std::int32_t a, std::int32_t b) {
    const auto c = tree_.component(a), d = tree_.component(b);
    if (c != mixed_components && d != mixed_components) {
      below(a, b, c == d ? within_ : across_);
      return;
    }
    if (stopped_ || !either_.asks(flags(a), flags(b))) return;
    if (a == b) {
      const auto child = tree_.child(a);
      below_mixed(child, child);
      below_mixed(child + 1, child + 1);
      below_mixed(child, child + 1);
      return;
    }
    ++counts_.box_tests;
    if (apart(tree_.box(a), tree_.box(b))) return;
    const bool splits_a = c == mixed_components, splits_b = d == mixed_components;
    const auto first_a = splits_a ? tree_.child(a) : a, first_b = splits_b ? tree_.child(b) : b;
    for (auto i = first_a; i <= first_a + splits_a; ++i) {
      for (auto j = first_b; j <= first_b + splits_b; ++j) below_mixed(i, j);
    }
  }

  // A node of one component against another or itself: one table serves all pairs below.
  void below(std::int32_t a, std::int32_t b, const PairTable& table) {
    if (stopped_ || !table.asks(flags(a), flags(b))) return;
    if (a == b) {
      enter_alone(a, table);
    } else {
      enter(a, b, table);
    }
    while (!stack_.empty() && !stopped_ && !(proofs_ && proofs_->is_stopped())) {
      const NodePair p = stack_.back();
      stack_.pop_back();
      if (p.a == p.b) {
        split_one(p.a, table);
      } else {
        split_both(p, table);
      }
    }
    stack_.clear();
  }

  void split_one(std::int32_t node, const PairTable& table) {
    const auto l = tree_.child(node), r = l + 1;
    enter_alone(r, table);
    enter_alone(l, table);
    if (table.asks(flags(l), flags(r))) enter(l, r, table);
  }

  void split_both(const NodePair& p, const PairTable& table) {
    const bool splits_a = !tree_.is_leaf(p.a), splits_b = !tree_.is_leaf(p.b);
    const auto a = splits_a ? tree_.child(p.a) : p.a, b = splits_b ? tree_.child(p.b) : p.b;
    for (auto i = a; i <= a + splits_a; ++i) {
      const auto partners = table.partners(flags(i));
      for (auto j = b; j <= b + splits_b; ++j) {
        if (partners & flags(j)) enter(i, j, table);
      }
    }
  }

  // A node that may hold a pair: onto the stack, unless no two triangles below it meet.
  void enter_alone(std::int32_t node, const PairTable& table) {
    if (tree_.is_leaf(node) || !table.asks(flags(node), flags(node))) return;
    if (proofs_ && proofs_->is_free(node)) return;
    stack_.push_back({node, node});
  }

  // Two nodes that may hold a pair: to the sink, or onto the stack, unless their boxes are apart.
  void enter(std::int32_t a, std::int32_t b, const PairTable& table) {
    if (skips_) {
      while (skip(a, b, table) || skip(b, a, table)) {
      }
    }
    ++counts_.box_tests;
    if (apart(tree_.box(a), tree_.box(b))) return;
    if (proofs_ && tree_.component(a) == tree_.component(b) && proofs_->are_free(a, b)) return;
    if (!tree_.is_leaf(a) || !tree_.is_leaf(b)) {
      stack_.push_back({a, b});
      return;
    }
    ++counts_.candidate_pairs;
    if (!stopped_ && !sink_(tree_.triangle(a), tree_.triangle(b))) stopped_ = true;
  }

  // Goes on to the only child of `node` that may hold a partner of `other`, if there is only one.
  bool skip(std::int32_t& node, std::int32_t other, const PairTable& table) {
    const auto partners = table.partners(flags(other));
    // Where every flag of the node is asked for, each child may hold a partner: it has some flag.
    if ((flags(node) & ~partners) == 0 || tree_.is_leaf(node)) return false;
    ++counts_.child_counts;
    const auto child = tree_.child(node);
    const bool first = (partners & flags(child)) != 0, second = (partners & flags(child + 1)) != 0;
    if (first == second) return false;
    node = first ? child : child + 1;
    ++counts_.skipped;
    return true;
  }

  const BoundingVolumeTree& tree_;
  const std::uint8_t* flags_;
  const PairTable within_, across_, either_;
  const bool skips_;
  PatchProofs* const proofs_;  // or null
  SearchCounts& counts_;
  const PairSink& sink_;
  std::vector<NodePair> stack_;  // of `below`: their boxes meet
  bool stopped_ = false;
};

}  // namespace

bool TreeSearch::search(const SearchInput& input, SearchCounts& counts,
                        const PairSink& sink) const {
  return descend(input, nullptr, counts, sink);
}

bool TreeSearch::descend(const SearchInput& input, PatchProofs* proofs, SearchCounts& counts,
                         const PairSink& sink) const {
  return Descent(input, skipping_ == Skipping::on, proofs, counts, sink).run();
}

bool ExhaustiveSearch::search(const SearchInput& input, SearchCounts& counts,
                              const PairSink& sink) const {
  const auto& component = input.mesh.component_of_triangle;
  const auto n = static_cast<std::int32_t>(input.mesh.triangles.size());
  for (std::int32_t a = 0; a < n; ++a) {
    const auto flags = input.marks.flags(a);
    for (std::int32_t b = a + 1; b < n; ++b) {
      const bool same = component[at(a)] == component[at(b)];
      const PairTable& table = same ? input.tables.within : input.tables.across;
      if (!table.asks(flags, input.marks.flags(b))) continue;
      ++counts.candidate_pairs;
      if (!sink(a, b)) return false;
    }
  }
  return true;
}

bool search_box(const BoundingVolumeTree& tree, const MovingBox& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink) {
  std::vector<std::int32_t> stack = {BoundingVolumeTree::root};
  while (!stack.empty()) {
    const auto node = stack.back();
    stack.pop_back();
    ++counts.box_tests;
    if (apart(tree.box(node), box)) continue;
    if (tree.is_leaf(node)) {
      ++counts.candidate_pairs;
      if (!sink(tree.triangle(node))) return false;
      continue;
    }
    stack.push_back(tree.child(node) + 1);
    stack.push_back(tree.child(node));
  }
  return true;
}

}  // namespace assay::detector
