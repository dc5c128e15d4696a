// The search of one step: it finds the candidate pairs, tests them for contact, and then closes
// the set of pairs in contact (L3, L7).
#pragma once

#include "detector/search/feature_contacts.h"
#include "detector/search/kept_features.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// The stages that a search is made of.
struct SearchStages {
  const PairRule& rule;
  const Marking& marking;
  MeshSearch& search;
  const ElementaryTest& elementary;
  const PairRelation* relation = nullptr;  // null: everything counts
};

// What is kept from one search to the next. Marks and representatives depend on the mesh and on the
// types that were marked last, on nothing else of the steps before.
struct SearchMemory {
  explicit SearchMemory(const BoundingVolumeTree& tree) : marks(tree) {}
  Marks marks;
  Representatives representatives;
  // Whether marks and representatives are of the same types; false after a stop between the two.
  bool is_whole = true;
  KeptFeatures near;  // of a step with these types
};

class CandidateSearch {
 public:
  // REQUIRES a stop function that all workers of `pace` may call, such as that of SharedStop. The
  // references must outlive this object.
  CandidateSearch(const SearchStages& stages, const Topology& mesh, const BoundingVolumeTree& tree,
                  SearchMemory& memory, const SteppedMesh& motion, const PacedStop& pace);

  // From now on only the first contact is looked for, and none later than the bound. As soon as a
  // contact is found that counts, those later than it are left out, and boxes need to cover no
  // more of the step. What is found then holds the first contact, and the pairs in contact at that
  // time which the whole search would hold. `tree`: that of the constructor, which is refitted.
  // REQUIRES that nothing was collected yet.
  void look_for_first(const TimeBound& bound, BoundingVolumeTree& tree);

  // A step calls mark; then collect, or collect_kept if all that may meet is kept; and close, if it
  // closes the set of pairs. Each returns false if it was stopped.

  // Sets the marks of the tree to these types, by triangle. REQUIRES none of those of the closure.
  bool mark(std::span<const TriangleType> types);
  // Finds the candidates and tests their feature pairs. With uses_proofs the search leaves out the
  // pairs that it can prove apart (PatchProofs). With `keeps` it keeps what was near for a later
  // question (L20). REQUIRES a search that was fitted to the step, with its tree.
  bool collect(bool uses_proofs = true, bool keeps = false);
  // Whether an earlier search of the same types has kept all that may meet. REQUIRES mark().
  bool is_kept() { return memory_.near.cover(motion_, first_ ? first_->asked_until : 1, pace_); }
  // Tests what is kept. REQUIRES is_kept().
  bool collect_kept();
  // See MeshSearch.
  ProvableShares provable_shares() const { return stages_.search.provable_shares(mesh_); }
  // An estimate, from a few hundred edges spread over the mesh: the share of pairs of triangles at
  // an edge that the rule asks for. REQUIRES that types are marked.
  double asked_share() const { return share_of_edges(false); }
  // The same of those pairs that are not proved apart by fans or sheets, which is done for that.
  double open_share() {
    prove_apart();
    return share_of_edges(true);
  }
  // The closure of L7. H starts as the triangles found in contact with their own component. Each
  // round tests (U,H) for the triangles that joined H last, and adds what is found, until H is
  // stable. Contacts of two components add nothing to H, because their pairs were all tested, and
  // layers count the own component only (L10). Triangles of V0 and Vv need no round, because they
  // were tested against everything already. A round costs the marks, search and tests around the
  // triangles that joined. It uses no proofs, because these would cost more than the round.
  bool close();

  // See FeatureContacts.
  std::vector<PairContact> take_contacts() { return contacts_.take(); }
  std::optional<bool> found_ignored() const { return contacts_.found_ignored(stop_); }
  bool take_counted(const std::vector<PairContact>& contacts, std::vector<PairContact>& counted) {
    return contacts_.take_counted(contacts, stop_, counted);
  }
  NarrowCounts narrow_counts() const { return contacts_.counts(); }
  double test_time() const { return contacts_.test_time(); }
  const SearchCounts& search_counts() const { return counts_; }
  const MarkingCounts& marking_counts() const { return marking_counts_; }
  std::uint64_t closure_rounds() const { return closure_rounds_; }

 private:
  bool search(const PairTables& tables, bool uses_proofs);
  void fit_features();
  // Proves pairs apart, once, if enough pairs of neighbours are asked for.
  void prove_apart();
  double share_of_edges(bool open_alone) const;
  // Takes the earliest contact so far for the bound. REQUIRES that all candidates so far were
  // tested.
  void lower_bound();
  // The same, and fits boxes to what is left of the step. False if it was stopped.
  bool tighten();
  bool change_types(std::span<const Marking::Change> changes);
  // Brings the representatives up to the marks.
  bool follow_marks();
  bool same_component(std::int32_t a, std::int32_t b) const;

  SearchStages stages_;
  const Topology& mesh_;
  const BoundingVolumeTree& tree_;
  SearchMemory& memory_;
  SteppedMesh motion_;
  const StopFunction& stop_;
  PacedStop pace_;
  FeatureContacts contacts_;
  SearchCounts counts_;
  MarkingCounts marking_counts_;
  std::uint64_t closure_rounds_ = 0;
  bool has_features_ = false, has_proved_apart_ = false;
  // Where the first contact is looked for: what it is found by.
  struct First {
    TimeBound bound;
    BoundingVolumeTree& tree;
    double asked_until;
    double fitted = 1;  // the boxes cover the step up to here
  };
  std::optional<First> first_;
};

}  // namespace assay::detector
