#include <bit>
#include <utility>

#include "detector/search/pair_search.h"
#include "detector/search/search_lanes.h"
#include "detector/search/sheets.h"

namespace assay::detector {
namespace {

using box_lanes::width;

// Two nodes of the wide tree whose boxes meet, or the same node twice.
struct WidePair {
  std::int32_t a, b;
};

// The other data that the lanes of this search share.
struct WideHunt : Hunt {
  WideHunt(const SearchInput& searched, const PairSink& taker)
      : Hunt(searched, taker),
        binary(searched.tree),
        tree(searched.tree.wide()),
        kernels(box_kernels()) {
    // In a step without views all triangles have one flag.
    const auto all = flags[BoundingVolumeTree::root];
    asks_everything = std::has_single_bit(all) && within.asks(all, all) && across.asks(all, all) &&
                      !searched.relation;
  }

  const BoundingVolumeTree& binary;
  const WideTree& tree;
  const BoxKernels& kernels;
  bool asks_everything = false;
};

// The flags of a node's children, a byte each.
struct ChildFlags {
  std::uint64_t bytes = 0;
  std::uint8_t of(std::size_t i) const { return static_cast<std::uint8_t>(bytes >> (8 * i)); }
  // Returns the children that have some flag of this set, as bits.
  std::uint8_t with(std::uint8_t set) const {
    constexpr std::uint64_t low = 0x7f7f7f7f7f7f7f7f, ones = 0x0101010101010101;
    const std::uint64_t some = bytes & (set * ones);
    const std::uint64_t high = ((some & low) + low) | some;  // bit 7 of each byte that is not 0
    constexpr std::uint64_t gather = 0x0002040810204081;
    return static_cast<std::uint8_t>(((high >> 7) & ones) * (gather << 7) >> 56);
  }
};

// The descent of one lane.
class WideDescent {
 public:
  WideDescent(WideHunt& hunt, std::size_t lane, SearchCounts& counts)
      : hunt_(hunt), tree_(hunt.tree), counts_(counts), found_(hunt, lane) {}

  std::vector<WidePair> cut(std::size_t count) {
    const auto split_into = [&](const WidePair& pair, std::vector<WidePair>& below) {
      split(pair);
      std::swap(below, stack_);
    };
    return cut_below<WidePair>({{WideTree::root, WideTree::root}}, count, split_into,
                               [&] { return is_ended(); });
  }

  // Searches all that lies below the pair.
  void run(const WidePair& pair) {
    stack_.push_back(pair);
    while (!stack_.empty() && !is_ended()) {
      const WidePair p = stack_.back();
      stack_.pop_back();
      split(p);
    }
    stack_.clear();
  }

  // Hands over the last candidates. Returns false if the search has ended early.
  bool finish() {
    found_.hand_over(is_ended());
    return !is_ended();
  }

 private:
  bool is_ended() const { return hunt_.is_stopped.load(std::memory_order_relaxed); }

  void split(const WidePair& p) {
    if (hunt_.input.sheets && hunt_.input.sheets->nodes_are_apart(p.a, p.b)) return;
    const auto &a = tree_.node(p.a), &b = tree_.node(p.b);
    if (p.a != p.b && a.holds_triangles != b.holds_triangles) {
      if (a.holds_triangles) {
        split_one(p.b, b, p.a);
      } else {
        split_one(p.a, a, p.b);
      }
      return;
    }
    LaneSets sets;
    ask(p, a, b, sets);
    counts_.box_tests += hunt_.kernels.compare_all(tree_.children(p.a), tree_.box(p.a),
                                                   tree_.children(p.b), tree_.box(p.b), sets);
    if (a.holds_triangles) {
      find(a, b, sets);
      return;
    }
    if (p.a == p.b) enter_each(a);
    for (std::size_t i = 0; i < a.count; ++i) {
      const auto child = tree_.child(a.first_slot + i);
      for (std::uint32_t left = sets[i]; left != 0; left &= left - 1)
        stack_.push_back({child, tree_.child(b.first_slot + lowest(left))});
    }
  }

  // Splits a pair of a node that holds nodes and a node that holds triangles.
  void split_one(std::int32_t n, const WideTree::Node& node, std::int32_t other) {
    counts_.box_tests += node.count;
    std::uint32_t meet = hunt_.kernels.compare_one(tree_.box(other), tree_.children(n));
    if (!hunt_.asks_everything) meet &= asked_of(node, tree_.binary_of(other));
    for (; meet != 0; meet &= meet - 1)
      stack_.push_back({tree_.child(node.first_slot + lowest(meet)), other});
  }

  void find(const WideTree::Node& a, const WideTree::Node& b, const LaneSets& sets) {
    const std::size_t before = found_.size();
    for (std::size_t i = 0; i < a.count; ++i) {
      const auto t = tree_.child(a.first_slot + i);
      for (std::uint32_t left = sets[i]; left != 0; left &= left - 1)
        found_.add(t, tree_.child(b.first_slot + lowest(left)));
    }
    counts_.candidate_pairs += found_.size() - before;
    if (found_.are_enough()) found_.hand_over(is_ended());
  }

  // Enters each child paired with itself. A single triangle holds no pair.
  void enter_each(const WideTree::Node& node) {
    for (std::size_t i = 0; i < node.count; ++i) {
      const auto slot = node.first_slot + i;
      const auto child = tree_.child(slot), binary = tree_.binary(slot);
      if (hunt_.binary.is_leaf(binary)) continue;
      if (!hunt_.asks_everything && !asks(binary, binary)) continue;
      stack_.push_back({child, child});
    }
  }

  // Sets, for each child of a, the children of b that it is to be compared with. If a and b are the
  // same node, each pair comes up once.
  void ask(const WidePair& p, const WideTree::Node& a, const WideTree::Node& b,
           LaneSets& sets) const {
    if (hunt_.asks_everything) {
      for (auto& set : sets) set = 0xff;
    } else if (const auto c = component(tree_.binary_of(p.a)), d = component(tree_.binary_of(p.b));
               c != mixed_components && d != mixed_components) {
      const PairTable& table = hunt_.table_of(c, d);
      const ChildFlags of_a = flags_of(a), of_b = flags_of(b);
      for (std::size_t i = 0; i < a.count; ++i) sets[i] = of_b.with(table.partners(of_a.of(i)));
    } else {
      for (std::size_t i = 0; i < a.count; ++i)
        sets[i] = asked_of(b, tree_.binary(a.first_slot + i));
    }
    if (p.a == p.b) {
      for (std::size_t i = 0; i < a.count; ++i) sets[i] &= static_cast<std::uint8_t>(0xfe << i);
    }
  }

  // Returns the children of a node, as bits, that are asked about together with a binary node.
  std::uint8_t asked_of(const WideTree::Node& node, std::int32_t other) const {
    std::uint8_t children = 0;
    for (std::size_t i = 0; i < node.count; ++i) {
      if (asks(tree_.binary(node.first_slot + i), other))
        children = static_cast<std::uint8_t>(children | 1u << i);
    }
    return children;
  }

  // Returns whether some pair below two binary nodes may be asked for.
  bool asks(std::int32_t a, std::int32_t b) const {
    const auto c = component(a), d = component(b);
    const auto p = hunt_.flags[at(a)], q = hunt_.flags[at(b)];
    if (c != mixed_components && d != mixed_components) return hunt_.table_of(c, d).asks(p, q);
    return hunt_.either.asks(p, q);
  }

  std::int32_t component(std::int32_t binary) const { return hunt_.binary.component(binary); }

  ChildFlags flags_of(const WideTree::Node& node) const {
    ChildFlags flags;
    for (std::size_t i = 0; i < node.count; ++i) {
      const std::uint64_t of_child = hunt_.flags[at(tree_.binary(node.first_slot + i))];
      flags.bytes |= of_child << (8 * i);
    }
    return flags;
  }

  static std::size_t lowest(std::uint32_t set) {
    return static_cast<std::size_t>(std::countr_zero(set));
  }

  WideHunt& hunt_;
  const WideTree& tree_;
  SearchCounts& counts_;
  std::vector<WidePair> stack_;
  FoundPairs found_;
};

struct WideLane {
  WideLane(WideHunt& hunt, std::size_t index) : descent(hunt, index, counts) {}
  SearchCounts counts;
  WideDescent descent;
};

}  // namespace

bool WideSearch::search(const SearchInput& input, SearchCounts& counts,
                        const PairSink& sink) const {
  WideHunt hunt(input, sink);
  WideDescent descent(hunt, 0, counts);
  return run_descent(input, sink.takes_lanes(), descent, counts,
                     [&](std::size_t lane) { return std::make_unique<WideLane>(hunt, lane); });
}

}  // namespace assay::detector
