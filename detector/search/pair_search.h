// The broad phase: finds the triangle pairs that the pair rule asks for and whose moving boxes are
// not apart.
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

// Proves, by other means than boxes, that pairs stay apart over the whole step (the pairs N of
// L14). REQUIRES that all triangles below the nodes are of one component.
class PatchProofs {
 public:
  virtual ~PatchProofs() = default;
  // Returns true only if no two triangles below the node are in contact during the step.
  virtual bool is_free(std::int32_t node) = 0;
  // Returns true only if no two triangles below a or b are in contact during the step. It is called
  // if the boxes of a and b meet.
  virtual bool are_free(std::int32_t a, std::int32_t b) = 0;
  // Returns whether the search has to stop. If so, the two functions above return false.
  virtual bool is_stopped() const { return false; }
  // Returns an object that makes the same proofs in one of several lanes (parallel/workers.h). Each
  // lane has its own counts and its own pace.
  virtual std::unique_ptr<PatchProofs> in_lane(std::size_t lane, SearchCounts& counts,
                                               PacedStop& pace) const = 0;
};

// The shares of patches that can be proved free over the step: of patches of a dozen, of three
// dozen and of a hundred triangles.
struct ProvableShares {
  double of_small = 0, of_medium = 0, of_large = 0;
};

// Two triangles, in any order.
struct CandidatePair {
  std::int32_t a, b;
};

// Receives the candidate pairs of a search. If it returns false, the search stops.
class PairSink {
 public:
  // A function that receives several pairs at once. It is called in lanes (parallel/workers.h),
  // which may run at the same time.
  using Take = std::function<bool(std::span<const CandidatePair>, std::size_t lane)>;
  static PairSink in_lanes(Take take) { return PairSink(std::move(take), true); }

  // Makes a sink that calls take(a, b) for one pair after the other. The search then runs in one
  // lane.
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
  // The stop function of `pace` is called during work that gives the sink no pairs, and its workers
  // share the search. If `pace` is null, no stop function is called, and the calling thread
  // searches alone.
  PacedStop* pace = nullptr;
  bool uses_proofs = true;  // whether proofs are worth their cost, if the search has any
  // If not null, the search leaves out pairs of components for which components_meet() is false; if
  // null, every pair counts.
  const PairRelation* relation = nullptr;
  // If not null, the search may leave out a pair if one of these sheets contains both triangles.
  const Sheets* sheets = nullptr;
  // If not empty, the search is done in rounds (search_lanes.h), and `between` is called after each
  // round except the last, when the sink has received all pairs found and no lane is working.
  // `between` may refit the tree to a shorter part of the step. If it returns false, the search
  // stops. A search may ignore `between`; then finding the first contact costs as much as finding
  // all contacts.
  std::function<bool()> between = {};

  // Returns whether pairs of the components c and d are searched; c may be d.
  bool components_meet(std::int32_t c, std::int32_t d) const {
    return !relation || relation->components_meet(c, d);
  }
};

class MeshSearch;

// The stage of the detector that finds candidates. It stores nothing from one call to the next,
// because several detectors can share it. `fit` and `search` return false if the sink or `pace` has
// stopped them.
class PairSearch {
 public:
  virtual ~PairSearch() = default;
  // Makes the search of one detector; called once, when the detector is created. The result refers
  // to this object. It must not refer to the mesh or the tree, because both are moved later. If
  // `pace` was stopped, the result must not be used.
  virtual std::unique_ptr<MeshSearch> prepare(const Topology& mesh, const BoundingVolumeTree& tree,
                                              PacedStop& pace) const;
  // Fits the tree to a step, before the searches of that step, unless an earlier stage has done so.
  virtual bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
                   PacedStop& pace) const {
    return tree.fit_once(mesh, motion, pace);
  }
  // Gives the sink all pairs that the tables ask for, except pairs that it can leave out. These
  // are: pairs whose grown boxes are apart; pairs left out by the relation or the sheets of the
  // input; and, with uses_proofs, pairs that it has proved apart. It must leave out no other pairs,
  // because feature pairs are kept for later steps (L20).
  virtual bool search(const SearchInput& input, SearchCounts& counts,
                      const PairSink& sink) const = 0;
};

// A search for one mesh, with the data that it keeps. Each detector has its own. This class keeps
// no data: it does what its PairSearch does. A derived class can make data once for the mesh, or
// keep data from `fit` for the searches of that step. For example, the search by normal cones keeps
// the contours of the mesh, and the places of its vertices during the step.
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
  // Returns whether this search proves patches apart if SearchInput::uses_proofs is true.
  virtual bool has_proofs() const { return false; }
  // Estimates the shares from a few patches, which do not depend on the tree. Returns zeros if the
  // search has no proofs. REQUIRES that `fit` was called for the step.
  virtual ProvableShares provable_shares(const Topology&) const { return {}; }

 private:
  const PairSearch& by_;
};

// Descends the tree against itself, along the partial trees of the sets in K: (V+,V-), (U,V0) and
// (U,Vv) in one pass. A PairTable says whether two nodes with given flags can contain a pair that
// is asked for.
//
// If only one child of a node can contain a partner for the other node, the search goes on with
// that child without a test of the node's box. The box of the child lies inside the box of the
// node, so a test of the box of the child shows more. In this way the search skips the nodes that
// the compact vBVH of the thesis leaves out.
//
// Pairs that PatchProofs proves apart are left out (L14). Proofs come after flags and boxes,
// because proofs cost more.
//
// If the pace has workers, the descent is cut into pairs of nodes near the root, and each worker
// does one such pair after the other. The work for a pair of nodes does not depend on other pairs,
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

// Finds every pair that the tables ask for, without boxes. O(M^2).
class ExhaustiveSearch : public PairSearch {
 public:
  bool fit(BoundingVolumeTree&, const Topology&, const SteppedMesh&, PacedStop&) const override {
    return true;
  }
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

// Gives the sink each triangle whose box is not apart from `box`, in a single descent. REQUIRES
// that `box` is from tree.box_of_triangle(), and that tree.join_boxes() was called. Returns false
// if the sink returned false.
bool search_box(const BoundingVolumeTree& tree, const MovingBox& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink);

// The broad phase on wide nodes (WideTree): the same candidates as TreeSearch, in less time.
//
// Descends the wide tree against itself. The flags of the children of two nodes say which pairs of
// children can contain a pair that is asked for. For these pairs, vector instructions compare the
// box of one child with up to eight other boxes at once. Nodes with a single child are not skipped,
// because a comparison costs less than finding these nodes.
//
// Workers share the descent as in TreeSearch. Candidates and counts are the same for any number of
// workers and any instruction set.
class WideSearch : public PairSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

}  // namespace assay::detector
