// The broad phase: it finds the triangle pairs that the pair rule asks for and whose moving boxes
// are not apart.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/search/pair_relation.h"
#include "detector/search/pair_rule.h"

namespace assay::detector {

// Proofs, other than by boxes, that pairs stay apart over the whole step (the pairs N of L14).
// They are asked for only if all triangles below the nodes are of one component.
class PatchProofs {
 public:
  virtual ~PatchProofs() = default;
  // Returns true only if no two triangles below the node are in contact during the step.
  virtual bool is_free(std::int32_t node) = 0;
  // Returns true only if no two triangles below a or b are in contact during the step.
  // It is asked if the boxes of a and b meet.
  virtual bool are_free(std::int32_t a, std::int32_t b) = 0;
  // Returns whether the search has to end; the two functions above then return false.
  virtual bool is_stopped() const { return false; }
  // Returns the same proofs for one lane of several (parallel/workers.h). A lane has counts and a
  // pace of its own.
  virtual std::unique_ptr<PatchProofs> in_lane(std::size_t lane, SearchCounts& counts,
                                               PacedStop& pace) const = 0;
};

// The shares of patches of a dozen, three dozen and a hundred triangles that are proved free over
// the step.
struct ProvableShares {
  double of_small = 0, of_medium = 0, of_large = 0;
};

// Two triangles, in any order.
struct CandidatePair {
  std::int32_t a, b;
};

// Takes the candidate pairs of a search. If it returns false the search stops.
class PairSink {
 public:
  // Takes several pairs at once, in lanes (parallel/workers.h) that may run at the same time.
  using Take = std::function<bool(std::span<const CandidatePair>, std::size_t lane)>;
  static PairSink in_lanes(Take take) { return PairSink(std::move(take), true); }

  // Takes one pair after the other with take(a, b). The search then runs in one lane.
  template <class TakeOne>
  requires std::invocable<TakeOne&, std::int32_t, std::int32_t> PairSink(TakeOne take)
      : take_([take = std::move(take)](std::span<const CandidatePair> pairs, std::size_t) mutable {
          return std::all_of(pairs.begin(), pairs.end(),
                             [&](const CandidatePair& pair) { return take(pair.a, pair.b); });
        }) {}

  bool operator()(std::span<const CandidatePair> pairs, std::size_t lane) const {
    return take_(pairs, lane);
  }
  bool operator()(std::int32_t a, std::int32_t b) const {
    const CandidatePair pair = {a, b};
    return take_({&pair, 1}, 0);
  }
  bool takes_lanes() const { return takes_lanes_; }

 private:
  PairSink(Take take, bool takes_lanes) : take_(std::move(take)), takes_lanes_(takes_lanes) {}
  Take take_;
  bool takes_lanes_ = false;
};

class Sheets;

struct SearchInput {
  const Topology& mesh;
  const BoundingVolumeTree& tree;  // fitted to the step
  const Marks& marks;              // of the step's types
  const PairTables& tables;
  // Its stop function is asked during work that gives the sink no pairs, and its workers do the
  // search. Null: nothing is asked, and the calling thread searches alone.
  PacedStop* pace = nullptr;
  bool uses_proofs = true;  // whether proofs, if the search has any, are worth their cost
  // If not null, the search leaves out the pairs of components that do not meet; null: everything
  // counts.
  const PairRelation* relation = nullptr;
  // If not null, the search may leave out the pairs that lie in one of these sheets.
  const Sheets* sheets = nullptr;
  // If this is empty, the search is done in one go. Else it is done in rounds (search_lanes.h), and
  // this is called between two rounds, when the sink has all pairs found and no lane works. It may
  // refit the tree, to a shorter part of the step. If it returns false the search stops. A search
  // may ignore this; finding the first contact then costs as much as finding all.
  std::function<bool()> between = {};

  // Returns whether pairs of the components c and d are searched; c may be d.
  bool components_meet(std::int32_t c, std::int32_t d) const {
    return !relation || relation->components_meet(c, d);
  }
};

class MeshSearch;

// The stage of the detector that finds candidates. It keeps nothing from one call to the next,
// because several detectors may share it. `fit` and `search` return false if they were stopped, by
// the sink or by `pace`.
class PairSearch {
 public:
  virtual ~PairSearch() = default;
  // Makes the search of a detector, once, when that is created. The result refers to this search.
  // It must not refer to the mesh or the tree, because both are moved later. If `pace` was stopped,
  // the result must not be used.
  virtual std::unique_ptr<MeshSearch> prepare(const Topology& mesh, const BoundingVolumeTree& tree,
                                              PacedStop& pace) const;
  // Fits the tree to a step, before the searches of that step, unless an earlier stage has done so.
  virtual bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
                   PacedStop& pace) const {
    return tree.fit_once(mesh, motion, pace);
  }
  // Hands out all pairs that may be in contact and that the tables ask for. It may leave out the
  // pairs whose grown boxes are apart, the pairs that the input names and, if proofs are wanted,
  // the pairs that it has proved apart. It leaves out no other pairs: later questions rest on that
  // (L20).
  virtual bool search(const SearchInput& input, SearchCounts& counts,
                      const PairSink& sink) const = 0;
};

// A search for one mesh, with the data that it keeps. Each detector has its own. This class keeps
// nothing: it does what its PairSearch does. A search derives from it if it makes something once
// for the mesh, or if it keeps something from `fit` for the searches of that step. For example, the
// search by normal cones keeps the contours of the mesh, and where its vertices are during the
// step.
class MeshSearch {
 public:
  explicit MeshSearch(const PairSearch& by) : by_(by) {}
  virtual ~MeshSearch() = default;

  // See PairSearch. The positions must outlive the searches of the step.
  virtual bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
                   PacedStop& pace) {
    return by_.fit(tree, mesh, motion, pace);
  }
  // REQUIRES that `fit` was called for the step.
  virtual bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) {
    return by_.search(input, counts, sink);
  }
  // Returns whether it proves patches apart when proofs are worth their cost (SearchInput).
  virtual bool has_proofs() const { return false; }
  // Estimates the shares from a few patches, the same for every tree. They are zero if the search
  // has no proofs. REQUIRES that `fit` was called for the step.
  virtual ProvableShares provable_shares(const Topology&) const { return {}; }

 private:
  const PairSearch& by_;
};

// Descends the tree against itself, along the partial trees that hold partners: (V+,V-), (U,V0) and
// (U,Vv) in one pass. A table says whether two nodes with given flags may hold a pair.
//
// If only one child of a node may hold a partner of the other node, the search goes on with that
// child before it tests any box. The child's box lies inside the node's box, so a test of the
// node's box would have told less. This passes over the nodes that the compact vBVH of the thesis
// leaves out.
//
// Pairs that patch proofs show to be apart are left out (L14). Proofs are asked for only if flags
// and boxes leave a pair possible, because they cost more.
//
// If the pace has workers, the descent is cut into pairs of nodes near the root, and each worker
// takes one of these after the other. The work for a pair of nodes does not depend on other pairs,
// so candidates and counts are the same for any number of workers.
class TreeSearch : public PairSearch {
 public:
  enum class Skipping : std::uint8_t { on, off };
  explicit TreeSearch(Skipping skipping = Skipping::on) : skipping_(skipping) {}
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;

 protected:
  bool descend(const SearchInput& input, PatchProofs* proofs, SearchCounts& counts,
               const PairSink& sink) const;

 private:
  Skipping skipping_;
};

// Takes every pair that the tables ask for, without boxes. O(M^2).
class ExhaustiveSearch : public PairSearch {
 public:
  bool fit(BoundingVolumeTree&, const Topology&, const SteppedMesh&, PacedStop&) const override {
    return true;
  }
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

// Gives the sink each triangle whose box is not apart from `box`, in a single descent. REQUIRES a
// box of tree.box_of_triangle, and joined boxes (BoundingVolumeTree::join_boxes). Returns false if
// the sink returned false.
bool search_box(const BoundingVolumeTree& tree, const MovingBox& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink);

// The broad phase on wide nodes (WideTree): the same candidates as TreeSearch, in less time.
//
// Descends the wide tree against itself. The flags of two nodes say which pairs of their children
// may hold a pair that is asked for. For these pairs, vector instructions compare the box of one
// child with up to eight others at once. No single-child node is passed over: a comparison costs
// less than finding out which nodes these are.
//
// If the pace has workers, the descent is cut into pairs of nodes near the root, and each worker
// takes one of these after the other (TreeSearch). Candidates and counts are the same for any
// number of workers and any instruction set.
class WideSearch : public PairSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

}  // namespace assay::detector
