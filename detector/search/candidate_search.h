// The search of one step: finds the candidate pairs, tests them for contact, and then does the
// closure, which completes the set of pairs in contact (L3, L7).
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
  const PairRelation* relation = nullptr;  // null: every pair counts
};

// What is kept from one search to the next. Marks and representatives depend only on the mesh and
// on the triangle types of the last marking.
struct SearchMemory {
  explicit SearchMemory(const BoundingVolumeTree& tree) : marks(tree) {}
  Marks marks;
  Representatives representatives;
  // Whether marks and representatives belong to the same triangle types; false if a stop came
  // between setting the marks and setting the representatives.
  bool is_whole = true;
  KeptFeatures near;  // from a step with the types of the last marking
};

class CandidateSearch {
 public:
  // REQUIRES that all workers of `pace` may call its stop function (SharedStop makes such a
  // function). The references must outlive this object.
  CandidateSearch(const SearchStages& stages, const Topology& mesh, const BoundingVolumeTree& tree,
                  SearchMemory& memory, const SteppedMesh& motion, const PacedStop& pace);

  // From now on, looks only for the first contact, and only for contacts up to the bound. As soon
  // as a contact that counts is found, later contacts are left out, and boxes cover the step only
  // up to its time. The contacts found include the first contact, and every pair in contact at that
  // time that a search for all contacts would find. `tree` is the tree of the constructor; it is
  // refitted. REQUIRES that collect() was not called yet.
  void look_for_first(const TimeBound& bound, BoundingVolumeTree& tree);

  // A step calls mark(); then collect_kept(), if feature pairs may be kept; then collect(), unless
  // is_answered(); and then close(), if it needs the closure. Each returns false if it was stopped.

  // Marks the tree with these types, by triangle. REQUIRES that no type is one of the grown or
  // joined types.
  bool mark(std::span<const TriangleType> types);
  // Finds the candidates and tests their feature pairs. With uses_proofs the search leaves out the
  // pairs that it can prove apart (PatchProofs). With `keeps` it keeps the near feature pairs for a
  // later step from the same start (L20). REQUIRES that the search and its tree were fitted to the
  // step.
  bool collect(bool uses_proofs = true, bool keeps = false);
  // Tests the feature pairs that an earlier search with the same types has kept, if they cover this
  // step. For a first contact it is enough that they cover the beginning of the step. REQUIRES
  // mark().
  bool collect_kept();
  // Returns whether collect_kept() has found all contacts that are looked for. If not, collect()
  // has to be called.
  bool is_answered() const {
    return kept_until_ >= asked_until() || (first_ && contacts_.least_end() <= kept_until_);
  }
  // See MeshSearch.
  ProvableShares provable_shares() const { return stages_.search.provable_shares(mesh_); }
  // Estimates which share of the pairs of triangles at a common edge the pair rule asks for, from a
  // few hundred edges spread over the mesh. REQUIRES mark().
  double asked_share() const { return share_of_edges(false); }
  // Does the same for pairs that neither fans nor sheets prove apart; finds fans and sheets first.
  double open_share() {
    prove_apart();
    return share_of_edges(true);
  }
  // Does the closure of L7. At first H is the set of triangles found in contact with their own
  // component. Each round tests the triangles that joined H last against their component (U,H), and
  // adds the triangles found in contact, until H is stable. Contacts between two components add
  // nothing to H, because all pairs of two components were tested, and layers count only the own
  // component (L10). Triangles of V0 and Vv need no round, because they were tested against
  // everything already. The cost of a round is marking, search and tests around the triangles that
  // joined. A round uses no proofs, because proofs would cost more than the round.
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
  // At the first call, proves pairs apart if the pair rule asks for enough pairs of neighbours.
  void prove_apart();
  double share_of_edges(bool open_alone) const;
  // Sets the bound to the time of the earliest contact so far. REQUIRES that all candidates so far
  // were tested.
  void take_earliest();
  // Does the same, and fits the boxes to the part of the step up to the bound. Returns false if
  // stopped.
  bool tighten();
  bool change_types(std::span<const Marking::Change> changes);
  // Updates the representatives to the types of the marks.
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
    double fitted = 1;  // the boxes cover the step up to this time
  };
  std::optional<First> first_;
  double asked_until() const { return first_ ? first_->asked_until : 1; }
  double kept_until_ = 0;  // all feature pairs that meet up to this time are kept
};

}  // namespace assay::detector
