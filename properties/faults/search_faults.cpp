// A wrong tree: marks that do not reach the root or are taken back too early, nodes that are
// skipped for the wrong partial tree, boxes of another step, and a search that detectors share.
#include <algorithm>
#include <atomic>

#include "properties/faults/planting.h"

namespace assay::properties {
namespace {

namespace flag = detector::flag;
using detector::BoundingVolumeTree;
using detector::MarkingCounts;
using detector::Marks;
using detector::PairSink;
using detector::PairTable;
using detector::SearchCounts;
using detector::SearchInput;
using detector::SteppedMesh;
using detector::Topology;

// A flag that is cleared at a leaf is cleared at all nodes above it, though another leaf there may
// have it.
struct ClearedForOthersToo : detector::Marking {
  void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
             MarkingCounts& counts) const override {
    for (std::int32_t node = leaf;; node = tree.parent(node)) {
      marks.node_flags[at(node)] &= static_cast<std::uint8_t>(~flags);
      ++counts.cleared;
      if (node == BoundingVolumeTree::root) return;
    }
  }
};

// Stops marking at a parent that has any flag, as if all nodes above it were then marked with this
// flag. They may be marked with another one.
struct MarkedUntilAnyFlag : detector::Marking {
  void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
            MarkingCounts& counts) const override {
    for (std::int32_t node = leaf;; node = tree.parent(node)) {
      auto& of_node = marks.node_flags[at(node)];
      const bool marked = node != leaf && (of_node & ~flag::positive) != 0;
      of_node |= flags;
      ++counts.marked;
      if (marked || node == BoundingVolumeTree::root) return;
    }
  }
};

// Gathers the flags of a parent from its first child alone.
struct GatheredFromFirstChild : detector::Marking {
  void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
             MarkingCounts& counts) const override {
    marks.node_flags[at(leaf)] &= static_cast<std::uint8_t>(~flags);
    ++counts.cleared;
    for (std::int32_t node = leaf; node != BoundingVolumeTree::root; ++counts.cleared) {
      node = tree.parent(node);
      marks.node_flags[at(node)] = marks.node_flags[at(tree.child(node))];
    }
  }
};

// Walks down the partial trees of V+, V-, V0 and Vv one after the other. If a node has a single
// child in the first tree that is asked for, the node is left for that child, though its other
// child may be in the next tree.
class SkippedForOneSet : public detector::TreeSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    return visit(input, BoundingVolumeTree::root, BoundingVolumeTree::root, counts, sink);
  }

 private:
  static PairTable table(const SearchInput& input, std::int32_t a, std::int32_t b) {
    const auto c = input.tree.component(a), d = input.tree.component(b);
    const bool mixed = c == detector::mixed_components || d == detector::mixed_components;
    if (mixed) return input.tables.within.joined_with(input.tables.across);
    return c == d ? input.tables.within : input.tables.across;
  }

  static std::int32_t skip(const SearchInput& input, std::int32_t node, std::int32_t other) {
    const auto& flags = input.marks.node_flags;
    while (!input.tree.is_leaf(node)) {
      const unsigned asked = table(input, node, other).partners(flags[at(other)]) & flags[at(node)];
      const unsigned first = asked & (~asked + 1);
      const auto child = input.tree.child(node);
      const bool left = (flags[at(child)] & first) != 0,
                 right = (flags[at(child + 1)] & first) != 0;
      if (left == right) break;
      node = left ? child : child + 1;
    }
    return node;
  }

  bool visit(const SearchInput& input, std::int32_t a, std::int32_t b, SearchCounts& counts,
             const PairSink& sink) const {
    const auto& tree = input.tree;
    const auto& flags = input.marks.node_flags;
    if (!table(input, a, b).asks(flags[at(a)], flags[at(b)])) return true;
    if (a == b) {
      if (tree.is_leaf(a)) return true;
      const auto child = tree.child(a);
      return visit(input, child, child, counts, sink) &&
             visit(input, child + 1, child + 1, counts, sink) &&
             visit(input, child, child + 1, counts, sink);
    }
    a = skip(input, a, b);
    b = skip(input, b, a);
    ++counts.box_tests;
    if (apart(tree.box(a), tree.box(b))) return true;
    if (tree.is_leaf(a) && tree.is_leaf(b)) {
      ++counts.candidate_pairs;
      return sink(tree.triangle(a), tree.triangle(b));
    }
    const bool splits_a = !tree.is_leaf(a);
    const auto child = tree.child(splits_a ? a : b);
    for (const auto below : {child, child + 1}) {
      if (!visit(input, splits_a ? below : a, splits_a ? b : below, counts, sink)) return false;
    }
    return true;
  }
};

// Fits the tree to the first step that searches, and to no other.
class FittedOnce : public detector::TreeSearch {
 public:
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           detector::PacedStop& pace) const override {
    fitted_ = fitted_ || TreeSearch::fit(tree, mesh, motion, pace);
    return fitted_;
  }

 private:
  mutable bool fitted_ = false;
};

// A search that was stopped is meant to continue where it was. But the next search, of whatever
// step, leaves out as many pairs as the stopped one had looked at.
class GoesOnAfterStop : public detector::TreeSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    std::uint64_t seen = 0;
    const bool completed = TreeSearch::search(input, counts, [&](std::int32_t a, std::int32_t b) {
      return ++seen <= looked_at_ || sink(a, b);
    });
    looked_at_ = completed ? 0 : std::max(seen, looked_at_);
    return completed;
  }

 private:
  mutable std::uint64_t looked_at_ = 0;
};

// All detectors of the process count their box tests in one place, and each takes the sum that
// accumulated while it searched for its own.
struct CountedTogether : detector::TreeSearch {
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    static std::atomic<std::uint64_t> box_tests = 0;
    const std::uint64_t before = box_tests;
    const std::uint64_t own_before = counts.box_tests;
    std::uint64_t told = own_before;
    const auto tell = [&] {
      box_tests += counts.box_tests - std::exchange(told, counts.box_tests);
    };
    const bool completed = TreeSearch::search(input, counts, [&](std::int32_t a, std::int32_t b) {
      tell();
      return sink(a, b);
    });
    tell();
    counts.box_tests = own_before + (box_tests - before);
    return completed;
  }
};

Fault disturbed(Fault fault) {
  fault.is_disturbed = true;
  return fault;
}

}  // namespace

std::vector<Fault> search_faults() {
  return {
      planted<ClearedForOthersToo>("marking/cleared-for-others-too",
                                   "a flag that one leaf loses is cleared on all nodes above", "L3",
                                   "F_cleared_for_others", 4),
      planted<MarkedUntilAnyFlag>(
          "marking/marked-until-any-flag",
          "marking ends at a node that has some flag other than P, not at one that has this flag",
          "L3", "F_marked_until_any_flag", 6),
      planted<GatheredFromFirstChild>("marking/gathered-from-first-child",
                                      "clearing gives a node the flags of its first child", "L3",
                                      "F_gathered_from_first_child", 4),
      planted<SkippedForOneSet>(
          "search/skipped-for-one-set",
          "a node is left for its only child in one partial tree, whatever the others hold", "L3",
          "F_skipped_for_one_set", 5),
      planted<FittedOnce>("search/fitted-once", "the tree is fitted to the first step and kept",
                          "free-sound", "F_fitted_once", 6),
      disturbed(planted<GoesOnAfterStop>(
          "search/goes-on-after-stop",
          "a step that was stopped leaves its place in the search behind, for the next one",
          "deterministic", "F_after_stop", 7)),
      disturbed(planted<CountedTogether>("search/counted-together",
                                         "all detectors of the process count their box tests in "
                                         "one place",
                                         "deterministic", "F_counted_together", 4)),
  };
}

}  // namespace assay::properties
