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

// The memory from one search to the next. Marks and representatives depend only on the mesh and on
// the types that were marked last.
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

  // Looks, from now on, only for the first contact, and for none later than the bound. As soon as a
  // counted contact is found, later ones are left out, and boxes cover the step only up to it. The
  // contacts found then include the first one and, of the pairs in contact at that time, those that
  // the whole search would find. `tree`: that of the constructor, which is refitted. REQUIRES that
  // nothing was collected yet.
  void look_for_first(const TimeBound& bound, BoundingVolumeTree& tree);

  // A step calls mark; then collect_kept, if pairs may be kept, and collect, unless these were
  // enough; and close, if it closes the set of pairs. Each returns false if it was stopped.

  // Sets the marks of the tree to these types, by triangle. REQUIRES that no type is one of the
  // closure.
  bool mark(std::span<const TriangleType> types);
  // Finds the candidates and tests their feature pairs. With uses_proofs the search leaves out the
  // pairs that it can prove apart (PatchProofs). With `keeps` it keeps the near feature pairs for a
  // later question (L20). REQUIRES a search that was fitted to the step, with its tree.
  bool collect(bool uses_proofs = true, bool keeps = false);
  // Tests the feature pairs that an earlier search of the same types has kept, if they cover the
  // question, or, for a first contact, at least the beginning of the step. REQUIRES mark().
  bool collect_kept();
  // Returns whether collect_kept() has found all that is asked for. Otherwise collect() has to.
  bool is_answered() const {
    return kept_until_ >= asked_until() || (first_ && contacts_.least_end() <= kept_until_);
  }
  // See MeshSearch.
  ProvableShares provable_shares() const { return stages_.search.provable_shares(mesh_); }
  // Estimates, from a few hundred edges spread over the mesh, the share of pairs of triangles at an
  // edge that the rule asks for. REQUIRES that types are marked.
  double asked_share() const { return share_of_edges(false); }
  // Does the same for the pairs that neither fans nor sheets prove apart. It finds fans and sheets
  // now.
  double open_share() {
    prove_apart();
    return share_of_edges(true);
  }
  // Does the closure of L7. H starts as the triangles found in contact with their own component.
  // Each round tests (U,H) for the triangles that joined H last, and adds the triangles found in
  // contact, until H is stable. Contacts of two components add nothing to H, because their pairs
  // were all tested, and layers count the own component only (L10). Triangles of V0 and Vv need no
  // round, because they were tested against everything already. A round costs the marks, search and
  // tests around the triangles that joined. It uses no proofs, because these would cost more than
  // the round.
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
  // Sets the bound to the earliest contact so far. REQUIRES that all candidates so far were tested.
  void take_earliest();
  // Does the same, and fits boxes to the rest of the step. Returns false if it was stopped.
  bool tighten();
  bool change_types(std::span<const Marking::Change> changes);
  // Updates the representatives to the types that the marks hold.
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
  // The data of a search for the first contact.
  struct First {
    TimeBound bound;
    BoundingVolumeTree& tree;
    double asked_until;
    double fitted = 1;  // the boxes cover the step up to here
  };
  std::optional<First> first_;
  double asked_until() const { return first_ ? first_->asked_until : 1; }
  double kept_until_ = 0;  // the time by which all feature pairs that meet are kept
};

}  // namespace assay::detector
