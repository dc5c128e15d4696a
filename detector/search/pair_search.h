// Broad phase: triangle pairs whose moving boxes are not apart and that the pair rule asks for.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/search/marking.h"

namespace assay::detector {

// What a search makes once for a mesh and works in later; each detector has its own.
struct KeptBySearch {
  virtual ~KeptBySearch() = default;
};

// What is proved apart over the whole step besides by boxes (N of L14). Asked of nodes of one
// component alone.
class PatchProofs {
 public:
  virtual ~PatchProofs() = default;
  // Whether no two triangles below the node are in contact during the step.
  virtual bool is_free(std::int32_t node) = 0;
  // Whether no two triangles below the two nodes together are, where the boxes meet.
  virtual bool are_free(std::int32_t a, std::int32_t b) = 0;
  // Whether the search has to end; the two above say false then.
  virtual bool is_stopped() const { return false; }
  // The same proofs for one lane of several (parallel/workers.h), which counts and asks for itself.
  virtual std::unique_ptr<PatchProofs> in_lane(std::size_t lane, SearchCounts& counts,
                                               PacedStop& pace) const = 0;
};

// Of patches of a dozen triangles and of a hundred, the share that is proved free over the step.
struct ProvableShares {
  double of_small = 0, of_large = 0;
};

// Two triangles, in any order.
struct CandidatePair {
  std::int32_t a, b;
};

// Takes candidate pairs; false: stop the search.
class PairSink {
 public:
  // Several at once, in lanes (parallel/workers.h) that may run at the same time.
  using Take = std::function<bool(std::span<const CandidatePair>, std::size_t lane)>;
  static PairSink in_lanes(Take take) { return PairSink(std::move(take), true); }

  // One pair after the other, take(a, b): the search then runs in one lane.
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

struct SearchInput {
  const Topology& mesh;
  const BoundingVolumeTree& tree;  // fitted to the step
  const Marks& marks;              // brought to its types
  const PairTables& tables;
  KeptBySearch* kept = nullptr;  // of PairSearch::prepare
  const PositionsView *x_t0 = nullptr, *x_t1 = nullptr;
  // Asked for what is done before and between the pairs, and it says who searches; null: never, and
  // the calling thread.
  PacedStop* pace = nullptr;
  bool uses_proofs = true;  // where the search has any: whether they are worth their cost
};

// A stage of the detector; returns false when it was stopped, by the sink or by `pace`.
class PairSearch {
 public:
  virtual ~PairSearch() = default;
  // In preprocessing; null where the tree is all that a search needs. Of no use where `pace` was
  // stopped.
  virtual std::unique_ptr<KeptBySearch> prepare(const Topology&, const BoundingVolumeTree&,
                                                PacedStop&) const {
    return nullptr;
  }
  // Brings the tree to a step, before the searches of that step.
  virtual bool fit(BoundingVolumeTree& tree, const Topology& mesh, const PositionsView& x_t0,
                   const PositionsView& x_t1, PacedStop& pace) const {
    return tree.refit(mesh, x_t0, x_t1, pace);
  }
  virtual bool search(const SearchInput& input, SearchCounts& counts,
                      const PairSink& sink) const = 0;
  // An estimate from a few patches, the same for every tree. None where it has no proofs.
  virtual ProvableShares provable_shares(const SearchInput&) const { return {}; }
};

// Descends the tree against itself, along the partial trees that hold partners: (V+,V-), (U,V0),
// (U,Vv) in one pass, as a table says for the flags of two nodes whether they may hold a pair.
//
// Where only one child of a node may hold a partner of the other node, the search goes on with that
// child before any box is tested: its box lies inside, so the test would have told less. With a
// marking that is one child with the flag, the compact vBVH of the thesis.
//
// What patch proofs tell apart is left out (L14). They are asked where a pair may lie below, for
// they cost more than a look at flags and boxes.
//
// Where the pace has workers, the descent is cut into pairs of nodes near the root, and each worker
// takes one of these after the other. What is looked at for a pair of nodes does not depend on
// others, so candidates and counts are the same for any number of workers.
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

// Looks at every pair, without boxes. O(M^2).
class ExhaustiveSearch : public PairSearch {
 public:
  bool fit(BoundingVolumeTree&, const Topology&, const PositionsView&, const PositionsView&,
           PacedStop&) const override {
    return true;
  }
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

// Triangles whose box is not apart from `box` (of tree.box_of_triangle), a single descent; false
// when the sink stopped it.
bool search_box(const BoundingVolumeTree& tree, const MovingBox& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink);

}  // namespace assay::detector
