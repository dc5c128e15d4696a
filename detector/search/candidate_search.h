// The candidate pairs of a step, their contacts, and the closure of these (L3, L7).
#pragma once

#include "detector/search/feature_contacts.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// The stages that a search is made of.
struct SearchStages {
  const PairRule& rule;
  const Marking& marking;
  const PairSearch& search;
  const ElementaryTest& elementary;
};

// What is kept from one search to the next: it depends on the types last marked alone, or on the
// mesh.
struct SearchMemory {
  // Of no use where `pace` was stopped.
  SearchMemory(const Topology& mesh, const BoundingVolumeTree& tree, PacedStop* pace = nullptr)
      : marks(tree), representatives(mesh, pace) {}
  Marks marks;
  Representatives representatives;
  bool is_whole = true;  // not stopped in between: marks and representatives are of the same types
  std::unique_ptr<KeptBySearch> kept;  // of PairSearch::prepare
};

class CandidateSearch {
 public:
  // tree: refitted to the step. The references must outlive this object.
  CandidateSearch(const SearchStages& stages, const Topology& mesh, const BoundingVolumeTree& tree,
                  SearchMemory& memory, const PositionsView& x_t0, const PositionsView& x_t1,
                  const StopFunction& stop);
  // The same by several workers; their stop function is one that they may share (SharedStop).
  CandidateSearch(const SearchStages& stages, const Topology& mesh, const BoundingVolumeTree& tree,
                  SearchMemory& memory, const PositionsView& x_t0, const PositionsView& x_t1,
                  const PacedStop& pace);

  // Brings the marks to the step: the types of all triangles, without those of the closure. This,
  // `collect` and `close` return false when `stop` ended it.
  bool mark(std::span<const TriangleType> types);
  // Finds the candidates and tests their feature pairs; what the search can prove apart is left out
  // where that is worth its cost.
  bool collect(bool uses_proofs = true);
  // See PairSearch.
  ProvableShares provable_shares();
  // Of the pairs of triangles at a few hundred edges that are spread over the mesh, the share that
  // the rule asks for. REQUIRES that types are marked.
  double asked_share() const;
  // L7. H := the triangles found in contact with their own component (pairs of two components were
  // all tested, and layers count the own component only: L10). Tests (U,H), adds what is found,
  // until H is stable. V0 and Vv were looked at against everything already. A round costs what it
  // looks at: marks, search and tests around the triangles that joined. Nothing is proved apart:
  // that would cost more than a round.
  bool close();

  // See FeatureContacts.
  std::vector<PairContact> take_contacts() { return contacts_.take(); }
  NarrowCounts narrow_counts() const { return contacts_.counts(); }
  double test_time() const { return contacts_.test_time(); }
  const SearchCounts& search_counts() const { return counts_; }
  const MarkingCounts& marking_counts() const { return marking_counts_; }
  std::uint64_t closure_rounds() const { return closure_rounds_; }

 private:
  bool search(const PairTables& tables, bool uses_proofs);
  SearchInput input(const PairTables& tables, bool uses_proofs);
  bool change_types(std::span<const Marking::Change> changes);
  // The representatives, after the marks.
  bool follow_marks();
  bool same_component(std::int32_t a, std::int32_t b) const;

  SearchStages stages_;
  const Topology& mesh_;
  const BoundingVolumeTree& tree_;
  SearchMemory& memory_;
  const PositionsView x_t0_, x_t1_;
  const StopFunction& stop_;
  PacedStop pace_;
  FeatureContacts contacts_;
  SearchCounts counts_;
  MarkingCounts marking_counts_;
  std::uint64_t closure_rounds_ = 0;
};

}  // namespace assay::detector
