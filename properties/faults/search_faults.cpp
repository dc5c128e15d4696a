// A wrong tree: marks that do not reach the root or are taken back too early, nodes that are
// skipped for the wrong partial tree, boxes of another step, a search that detectors share, and
// wrong normal cones.

#include <algorithm>
#include <atomic>

#include "detector/traditional/traditional.h"
#include "properties/faults/planting.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace

namespace {

namespace flag = detector::flag;

// A flag that is cleared at a leaf is cleared at all nodes above it, though another leaf there may
// have it.
struct ClearedForOthersToo : Marking {
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
// flag. In truth they may have another flag only.
struct MarkedUntilAnyFlag : Marking {
  void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
            MarkingCounts& counts) const override {
    for (std::int32_t node = leaf;; node = tree.parent(node)) {
      auto& of_node = marks.node_flags[at(node)];
      const bool is_marked = node != leaf && (of_node & ~flag::positive) != 0;
      of_node |= flags;
      ++counts.marked;
      if (is_marked || node == BoundingVolumeTree::root) return;
    }
  }
};

// Gathers the flags of a parent from its first child alone.
struct GatheredFromFirstChild : Marking {
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
class SkippedForOneSet : public TreeSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    return input.tree.join_boxes(input.pace) &&
           visit(input, BoundingVolumeTree::root, BoundingVolumeTree::root, counts, sink);
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
      const unsigned both = table(input, node, other).partners(flags[at(other)]) & flags[at(node)];
      const unsigned first = both & (~both + 1);
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
class FittedOnce : public TreeSearch {
 public:
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    fitted_ = fitted_ || TreeSearch::fit(tree, mesh, motion, pace);
    return fitted_;
  }

 private:
  mutable bool fitted_ = false;
};

// A search that was stopped is meant to continue where it was. But the next search, of whatever
// step, leaves out as many pairs as the stopped one had looked at.
class GoesOnAfterStop : public TreeSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    std::uint64_t count = 0;
    const bool completed = TreeSearch::search(input, counts, [&](std::int32_t a, std::int32_t b) {
      return ++count <= looked_at_ || sink(a, b);
    });
    looked_at_ = completed ? 0 : std::max(count, looked_at_);
    return completed;
  }

 private:
  mutable std::uint64_t looked_at_ = 0;
};

// All detectors of the process count their box tests in one place, and each takes all that came
// together during its search for its own count.
struct CountedTogether : TreeSearch {
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    static std::atomic<std::uint64_t> box_tests = 0;
    const std::uint64_t before = box_tests;
    const std::uint64_t own_before = counts.box_tests;
    std::uint64_t own_count = own_before;
    const auto tell = [&] {
      box_tests += counts.box_tests - std::exchange(own_count, counts.box_tests);
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
      {wrong<ClearedForOthersToo>, "marking/cleared-for-others-too", "L3", "F_cleared_for_others",
       4, "a flag that one leaf loses is cleared on all nodes above"},
      {wrong<MarkedUntilAnyFlag>, "marking/marked-until-any-flag", "L3", "F_marked_until_any_flag",
       6, "marking ends at a node with any flag except P, instead of at a node with the same flag"},
      {wrong<GatheredFromFirstChild>, "marking/gathered-from-first-child", "L3",
       "F_gathered_from_first_child", 4, "clearing gives a node the flags of its first child"},
      {wrong<SkippedForOneSet>, "search/skipped-for-one-set", "L3", "F_skipped_for_one_set", 5,
       "a node with one child in one partial tree is skipped, though it has two in another one"},
      {wrong<FittedOnce>, "search/fitted-once", "free-sound", "F_fitted_once", 6,
       "the tree is fitted to the first step and kept"},
      disturbed(Fault{
          wrong<GoesOnAfterStop>, "search/goes-on-after-stop", "deterministic", "F_after_stop", 7,
          "a stopped search is continued by the next step from the place where it stopped"}),
      disturbed(Fault{wrong<CountedTogether>, "search/counted-together", "deterministic",
                      "F_counted_together", 4,
                      "all detectors of the process count their box tests in one place"}),
  };
}

// Wrong normal cones and contours (L13): the mistakes of the classical form of the traditional
// scheme. See detector/traditional/traditional.cpp.

namespace {

using Triangle = std::array<MovingPoint, 3>;

Triangle at_rest(Triangle triangle, bool at_end) {
  for (auto& p : triangle) (at_end ? p.t0 : p.t1) = at_end ? p.t1 : p.t0;
  return triangle;
}

struct NormalsAtEnd : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    return detector::faced_directions(at_rest(triangle, true));
  }
};

struct NormalsAtBothEnds : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    return detector::faced_directions(at_rest(triangle, false)) &
           detector::faced_directions(at_rest(triangle, true));
  }
};

// Tests N.d >= 0 in place of N.d > 0.
struct EdgeOnFaced : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    const auto n = detector::cross(detector::difference(triangle[1], triangle[0]),
                                   detector::difference(triangle[2], triangle[0]));
    DirectionSet set = 0;
    for (int bit = 0; bit < detector::facing_directions; ++bit) {
      const auto d = detector::direction(bit);
      const bool is_faced =
          detector::dot(n.b0, d) >= 0 && detector::dot(n.b1, d) >= 0 && detector::dot(n.b2, d) >= 0;
      set |= DirectionSet{is_faced} << bit;
    }
    return set;
  }
};

struct NoContourTest : NormalConeSearch {
  bool stays_simple(MovingContour&, Contour, int) const override { return true; }
};

struct ContourAtEnd : NormalConeSearch {
  bool stays_simple(MovingContour& moving, Contour contour, int direction_bit) const override {
    const auto& end = moving.motion().vertices_t1;
    return MovingContour({end, end}).stays_simple(contour, direction_bit);
  }
};

// Triangles that are connected at a vertex only are taken for one patch, and the first walk around
// some of them is taken for its contour.
struct FirstWalk : ContourMaker {
  using ContourMaker::ContourMaker;
  void append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out) override {
    if (boundary.empty()) return;
    std::vector<std::int32_t> walk = {from(boundary[0])};
    for (;;) {
      const auto leaves =
          std::ranges::find_if(boundary, [&](DirectedEdge e) { return from(e) == walk.back(); });
      const auto again = std::ranges::find(walk, to(*leaves));
      if (again != walk.end()) {
        out.insert(out.end(), again, walk.end());
        return;
      }
      walk.push_back(to(*leaves));
    }
  }
};

struct JoinedAtVertex : NormalConeSearch {
  std::unique_ptr<ContourMaker> contour_maker(const Topology& mesh) const override {
    return std::make_unique<FirstWalk>(mesh);
  }
};

// Two patches that are each free by itself, and face one direction, are taken to be free together.
struct PatchesOneByOne : NormalConeSearch {
  Contour joined(ContourUnion&, Contour a, Contour b) const override {
    return a.size() < b.size() ? b : a;
  }
};

// In exact arithmetic Culling::automatic hardly ever asks for cones, because fans prove the same.
constexpr Options auto_with_cones{Culling::automatic, Start::verified, Pairs::all,
                                  Arithmetic::bounded};

}  // namespace

std::vector<Fault> cone_faults() {
  return {
      {wrong<NormalsAtEnd>, "cone/normals-at-end", "all-pairs (L13)", "F_cone_normals_at_end", 4,
       "a normal cone is made of the normals at t=1 only", with_cones},
      {wrong<NormalsAtBothEnds>, "cone/normals-at-both-ends", "all-pairs (L13)",
       "F_cone_normals_at_both_ends", 4, "a normal cone is made of the normals at t=0 and t=1 only",
       with_cones},
      {wrong<EdgeOnFaced>, "cone/edge-on-faced", "all-pairs (L13)", "F_cone_edge_on", 4,
       "N.d >= 0 is taken for N.d > 0", with_cones},
      {wrong<NoContourTest>, "cone/no-contour-test", "all-pairs (L13)", "F_cone_no_contour_test", 5,
       "a patch with a normal cone counts as free without a contour test", with_cones},
      {wrong<ContourAtEnd>, "cone/contour-at-end", "all-pairs (L13)", "F_cone_contour_at_end", 5,
       "the contour is tested at t=1 only", with_cones},
      {wrong<JoinedAtVertex>, "cone/joined-at-a-vertex", "all-pairs (L13)",
       "F_cone_joined_at_vertex", 4, "patches that share only a vertex are merged", with_cones},
      {wrong<PatchesOneByOne>, "cone/patches-one-by-one", "all-pairs (L13)",
       "F_cone_patches_one_by_one", 5,
       "two patches, each free and facing one way, are taken as free together", with_cones},
      {wrong<PatchesOneByOne>, "auto/patches-one-by-one", "L14", "F_auto_patches_one_by_one", 71,
       "culling auto leaves out pairs of two patches if each patch is free", auto_with_cones},
      {wrong<NormalsAtEnd>, "auto/normals-at-end", "L14", "F_auto_normals_at_end", 49,
       "culling auto leaves out patches if they face one direction at t=1", auto_with_cones},
  };
}

}  // namespace assay::properties
