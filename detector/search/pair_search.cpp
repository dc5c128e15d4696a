#include "detector/search/pair_search.h"

#include <utility>

#include "detector/mesh/for_all.h"
#include "detector/search/search_lanes.h"

namespace assay::detector {
namespace {

// A pair of nodes below which pairs may lie: flags and boxes have been looked at.
struct NodePair {
  std::int32_t a, b;
};

// The descent of one lane.
class Descent {
 public:
  Descent(Hunt& hunt, bool skips, PatchProofs* proofs, std::size_t lane, SearchCounts& counts)
      : hunt_(hunt),
        tree_(hunt.input.tree),
        flags_(hunt.flags),
        skips_(skips),
        proofs_(proofs),
        counts_(counts),
        found_(hunt, lane) {}

  std::vector<NodePair> cut(std::size_t count) {
    arrive(BoundingVolumeTree::root, BoundingVolumeTree::root);
    const auto split_into = [&](const NodePair& pair, std::vector<NodePair>& below) {
      split(pair);
      std::swap(below, stack_);
    };
    return cut_below(std::exchange(stack_, {}), count, split_into, [&] { return is_ended(); });
  }

  // Searches all that lies below the pair.
  void run(const NodePair& pair) {
    above_.push_back(pair);
    while (!above_.empty() && !is_ended()) {
      const NodePair p = above_.back();
      above_.pop_back();
      split(p);
      if (is_mixed(p)) {
        above_.insert(above_.end(), stack_.begin(), stack_.end());
      } else {
        drain(table_of(p));
      }
      stack_.clear();
    }
    above_.clear();
  }

  // Hands over the last candidates. Returns false if the search has ended early.
  bool finish() {
    found_.hand_over(is_ended());
    return !is_ended();
  }

 private:
  bool is_ended() const {
    return hunt_.is_stopped.load(std::memory_order_relaxed) || (proofs_ && proofs_->is_stopped());
  }
  std::uint8_t flags(std::int32_t node) const { return flags_[at(node)]; }
  bool is_mixed(const NodePair& p) const {
    return tree_.component(p.a) == mixed_components || tree_.component(p.b) == mixed_components;
  }
  const PairTable& table_of(const NodePair& p) const {
    return hunt_.table_of(tree_.component(p.a), tree_.component(p.b));
  }

  // Empties the stack. One table serves all pairs below a pair that is not mixed.
  void drain(const PairTable& table) {
    while (!stack_.empty() && !is_ended()) {
      const NodePair p = stack_.back();
      stack_.pop_back();
      split(p, table);
    }
  }

  void split(const NodePair& p) {
    if (is_mixed(p)) {
      split_mixed(p);
    } else {
      split(p, table_of(p));
    }
  }
  void split(const NodePair& p, const PairTable& table) {
    if (p.a == p.b) {
      split_one(p.a, table);
    } else {
      split_both(p, table);
    }
  }

  // Splits nodes that hold several components, and pairs with such a node.
  void split_mixed(const NodePair& p) {
    if (p.a == p.b) {
      const auto child = tree_.child(p.a);
      arrive(child, child);
      arrive(child + 1, child + 1);
      arrive(child, child + 1);
      return;
    }
    const bool splits_a = tree_.component(p.a) == mixed_components,
               splits_b = tree_.component(p.b) == mixed_components;
    const auto first_a = splits_a ? tree_.child(p.a) : p.a,
               first_b = splits_b ? tree_.child(p.b) : p.b;
    for (auto i = first_a; i <= first_a + splits_a; ++i) {
      for (auto j = first_b; j <= first_b + splits_b; ++j) arrive(i, j);
    }
  }

  // Puts two nodes, of whatever components, onto the stack if a pair may lie below.
  void arrive(std::int32_t a, std::int32_t b) {
    if (is_mixed({a, b})) {
      if (!hunt_.either.asks(flags(a), flags(b))) return;
      if (a != b) {
        ++counts_.box_tests;
        if (apart(tree_.box(a), tree_.box(b))) return;
      }
      stack_.push_back({a, b});
      return;
    }
    const PairTable& table = table_of({a, b});
    if (a == b) {
      enter_alone(a, table);
    } else if (table.asks(flags(a), flags(b))) {
      enter(a, b, table);
    }
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

  // Puts a node that may hold a pair onto the stack, unless it is proved free.
  void enter_alone(std::int32_t node, const PairTable& table) {
    if (tree_.is_leaf(node) || !table.asks(flags(node), flags(node))) return;
    if (proofs_ && proofs_->is_free(node)) return;
    stack_.push_back({node, node});
  }

  // Gives two nodes that may hold a pair to the sink (two leaves) or puts them onto the stack,
  // unless they are shown to be apart.
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
    found_.add(tree_.triangle(a), tree_.triangle(b));
    if (found_.are_enough()) found_.hand_over(is_ended());
  }

  // Goes on to the only child of `node` that may hold a partner of `other`, if there is only one.
  bool skip(std::int32_t& node, std::int32_t other, const PairTable& table) {
    const auto partners = table.partners(flags(other));
    // If all flags of the node are asked for, both children may hold a partner: each has a flag.
    if ((flags(node) & ~partners) == 0 || tree_.is_leaf(node)) return false;
    ++counts_.child_counts;
    const auto child = tree_.child(node);
    const bool first = (partners & flags(child)) != 0, second = (partners & flags(child + 1)) != 0;
    if (first == second) return false;
    node = first ? child : child + 1;
    ++counts_.skipped;
    return true;
  }

  Hunt& hunt_;
  const BoundingVolumeTree& tree_;
  const std::uint8_t* const flags_;
  const bool skips_;
  PatchProofs* const proofs_;  // or null
  SearchCounts& counts_;
  std::vector<NodePair> above_, stack_;
  FoundPairs found_;
};

// One of several lanes; each takes the next pair of nodes when it is done with the last one.
struct Lane {
  Lane(Hunt& hunt, bool skips, const PatchProofs* all_proofs, const StopFunction& stop,
       std::size_t index)
      : pace(stop),
        proofs(all_proofs ? all_proofs->in_lane(index, counts, pace) : nullptr),
        descent(hunt, skips, proofs.get(), index, counts) {}
  SearchCounts counts;
  PacedStop pace;
  std::unique_ptr<PatchProofs> proofs;
  Descent descent;
};

}  // namespace

std::unique_ptr<MeshSearch> PairSearch::prepare(const Topology&, const BoundingVolumeTree&,
                                                PacedStop&) const {
  return std::make_unique<MeshSearch>(*this);
}

bool TreeSearch::search(const SearchInput& input, SearchCounts& counts,
                        const PairSink& sink) const {
  return descend(input, nullptr, counts, sink);
}

bool TreeSearch::descend(const SearchInput& input, PatchProofs* proofs, SearchCounts& counts,
                         const PairSink& sink) const {
  SearchInput joined = input;
  const auto join = [&] { return input.tree.join_boxes(input.pace); };
  // input.between() may fit the boxes to a shorter step, so they are joined again after it.
  if (input.between) joined.between = [&] { return input.between() && join(); };
  if (!join()) return false;
  Hunt hunt(joined, sink);
  const bool skips = skipping_ == Skipping::on;
  Descent descent(hunt, skips, proofs, 0, counts);
  return run_descent(joined, sink.takes_lanes(), descent, counts, [&](std::size_t lane) {
    return std::make_unique<Lane>(hunt, skips, proofs, input.pace->stop(), lane);
  });
}

bool ExhaustiveSearch::search(const SearchInput& input, SearchCounts& counts,
                              const PairSink& sink) const {
  const auto& component = input.mesh.component_of_triangle;
  const auto n = static_cast<std::int32_t>(input.mesh.triangles.size());
  for (std::int32_t a = 0; a < n; ++a) {
    const auto flags = input.marks.flags(a);
    for (std::int32_t b = a + 1; b < n; ++b) {
      const auto c = component[at(a)], d = component[at(b)];
      const PairTable& table = c == d ? input.tables.within : input.tables.across;
      if (!table.asks(flags, input.marks.flags(b)) || !input.components_meet(c, d)) continue;
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
