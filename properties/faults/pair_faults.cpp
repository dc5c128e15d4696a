// Wrong candidate pairs: blocks of K left out (L3), neighbours and zero areas skipped, closures
// that stop too early (L7), boxes that are too small.
#include <algorithm>

#include "detector/geometry/winding.h"
#include "properties/faults/planting.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace
namespace {

namespace flag = detector::flag;

// K with other tables.
template <void (*change)(PairTables&)>
struct Changed : PairRule {
  PairTables candidates() const override {
    PairTables tables = PairRule::candidates();
    change(tables);
    return tables;
  }
};

template <std::uint8_t a, std::uint8_t b>
void without(PairTables& tables) {
  tables.within.remove(a, b);
}

void only_opposite_signs(PairTables& tables) {
  for (const auto u : {flag::positive, flag::negative, flag::zero})
    tables.within.remove(u, flag::zero);
}

void across_by_sign(PairTables& tables) { tables.across = tables.within; }

struct NoClosure : PairRule {
  PairTables closure() const override { return {}; }
};

struct ClosureFromOneSide : PairRule {
  bool joins_closure(const TrianglePair& contact, std::int32_t t) const override {
    return t == contact.a;
  }
};

// Tests the triangles that joined the closure against V+ alone.
struct ClosureLeavesNegative : PairRule {
  PairTables closure() const override {
    PairTables tables;
    tables.within.add(flag::positive, flag::grown);
    return tables;
  }
};

// The standard search, which withholds some of its pairs from the sink.
class FilteredSearch : public TreeSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    return TreeSearch::search(input, counts, [&](std::int32_t a, std::int32_t b) {
      return skips(input.mesh, a, b) || sink(a, b);
    });
  }
  virtual bool skips(const Topology& mesh, std::int32_t a, std::int32_t b) const = 0;
};

template <int common>
struct NeighboursSkipped : FilteredSearch {
  bool skips(const Topology& mesh, std::int32_t a, std::int32_t b) const override {
    int shared = 0;
    for (const auto u : mesh.triangles[at(a)]) {
      for (const auto v : mesh.triangles[at(b)]) shared += u == v;
    }
    return shared >= common;
  }
};

// Leaves out a triangle that has no area at t=0 or t=1, as if nothing could be hit there.
class ZeroAreaDropped : public FilteredSearch {
 public:
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    if (!FilteredSearch::fit(tree, mesh, motion, pace)) return false;
    dropped_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < dropped_.size(); ++t) {
      const auto triangle = static_cast<std::int32_t>(t);
      dropped_[t] = detector::has_zero_area(mesh, motion.vertices_t0, triangle) ||
                    detector::has_zero_area(mesh, motion.vertices_t1, triangle);
    }
    return true;
  }
  bool skips(const Topology&, std::int32_t a, std::int32_t b) const override {
    return dropped_[at(a)] || dropped_[at(b)];
  }

 private:
  mutable std::vector<std::uint8_t> dropped_;  // of the step at hand; one detector, one thread
};

struct Box {
  double lo[3], hi[3];
};

Box swept_box(const std::array<std::int32_t, 3>& triangle, const SteppedMesh& motion) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = box.hi[k] = motion.vertices_t0(triangle[0], k);
    for (const auto v : triangle) {
      for (const double x : {motion.vertices_t0(v, k), motion.vertices_t1(v, k)}) {
        box.lo[k] = std::min(box.lo[k], x);
        box.hi[k] = std::max(box.hi[k], x);
      }
    }
  }
  return box;
}

// Takes boxes that only touch for apart. So contacts in their common face are lost.
class OpenBoxes : public FilteredSearch {
 public:
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    if (!FilteredSearch::fit(tree, mesh, motion, pace)) return false;
    boxes_.clear();
    for (const auto& triangle : mesh.triangles) {
      boxes_.push_back(swept_box(triangle, motion));
    }
    return true;
  }
  bool skips(const Topology&, std::int32_t a, std::int32_t b) const override {
    for (int k = 0; k < 3; ++k) {
      const auto &box = boxes_[at(a)], &other = boxes_[at(b)];
      if (!(box.lo[k] < other.hi[k] && other.lo[k] < box.hi[k])) return true;
    }
    return false;
  }

 private:
  mutable std::vector<Box> boxes_;  // of the step at hand
};

template <bool end>
struct StillBoxes : TreeSearch {
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    const PositionsView& x = end ? motion.vertices_t1 : motion.vertices_t0;
    return tree.refit(mesh, {x, x}, pace);
  }
};

// Searches K and one round of the closure. The triangles found in that round start no further
// round.
class SinglePassClosure : public TreeSearch {
 public:
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    searches_ = 0;
    return TreeSearch::fit(tree, mesh, motion, pace);
  }
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    return ++searches_ > 2 || TreeSearch::search(input, counts, sink);
  }

 private:
  mutable int searches_ = 0;  // of the step at hand
};

}  // namespace

std::vector<Fault> pair_faults() {
  return {
      {wrong<Changed<without<flag::zero, flag::zero>>>, "pair/zero-zero-dropped", "L3",
       "C6_only_ZZ", 4, "(V0,V0) is left out"},
      {wrong<Changed<without<flag::positive, flag::zero>>>, "pair/positive-zero-dropped", "L3",
       "C6_only_PZ", 4, "(V+,V0) is left out"},
      {wrong<Changed<without<flag::negative, flag::zero>>>, "pair/negative-zero-dropped", "L3",
       "C6_only_MZ", 5, "(V-,V0) is left out"},
      {wrong<Changed<without<flag::positive, flag::negative>>>, "pair/positive-negative-dropped",
       "L3", "C6_only_PM", 5, "(V+,V-) is left out"},
      {wrong<Changed<only_opposite_signs>>, "pair/only-opposite-signs", "L3", "M_pOnlyPM", 4,
       "only (V+,V-) is kept besides Vv"},
      {wrong<Changed<without<flag::violated, flag::violated>>>, "pair/u-without-violated", "L11",
       "D5_U_minus_Vv", 7, "U is reduced by Vv: (Vv,Vv) is left out"},
      {wrong<Changed<without<flag::positive, flag::violated>>>, "pair/positive-violated-dropped",
       "L11", "F_positive_violated", 4, "(V+,Vv) is left out"},
      {wrong<Changed<without<flag::negative, flag::violated>>>, "pair/negative-violated-dropped",
       "L11", "F_negative_violated", 4, "(V-,Vv) is left out"},
      {wrong<Changed<without<flag::zero, flag::violated>>>, "pair/zero-violated-dropped", "L11",
       "F_zero_violated", 4, "(V0,Vv) is left out"},
      {wrong<Changed<across_by_sign>>, "pair/across-by-sign", "L10", "A2_nested_outward", 9,
       "pairs of two components are judged by sign"},
      {wrong<NoClosure>, "pair/no-closure", "all-pairs (L7)", "F_closure_one_side", 6,
       "the pairs of K are reported as all pairs"},
      {wrong<ClosureFromOneSide>, "pair/closure-from-one-side", "all-pairs (L7)",
       "F_closure_one_side", 6, "only the lower-numbered triangle of a contact joins the closure"},
      {wrong<ClosureLeavesNegative>, "pair/closure-leaves-negative", "all-pairs (L7)",
       "C2_lost_minus_minus", 8, "the closure looks at V+ only, not at V-"},
      {wrong<NeighboursSkipped<1>>, "pair/vertex-sharing-skipped", "L3", "C3_skip_adjacent", 6,
       "triangles with a common vertex are no candidates"},
      {wrong<NeighboursSkipped<2>>, "pair/edge-sharing-skipped", "L3", "M_pSkipEdge", 5,
       "triangles with a common edge are no candidates"},
      {wrong<ZeroAreaDropped>, "pair/zero-area-dropped", "L12", "A3_nonstrict_end", 7,
       "a triangle that has no area at t=0 or t=1 is no candidate"},
      {wrong<OpenBoxes>, "pair/open-boxes", "free-sound", "F_open_boxes", 4,
       "boxes that only touch do not meet"},
      {wrong<StillBoxes<false>>, "pair/boxes-at-start", "free-sound", "F_boxes_at_start", 6,
       "boxes hold only the places at t=0"},
      {wrong<StillBoxes<true>>, "pair/boxes-at-end", "free-sound", "F_boxes_at_end", 6,
       "boxes hold only the places at t=1"},
      {wrong<SinglePassClosure>, "pair/closure-single-pass", "all-pairs (L7)", "", 0,
       "the closure ends after its first round", with_points, FaultStatus::open,
       "no case is known in which the second round finds a pair that the first round has not "
       "found"},
  };
}

}  // namespace assay::properties
