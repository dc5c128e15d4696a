// The candidate pairs of a step, their contacts, and the closure of these (L3, L7).
#pragma once

#include "detector/search/feature_contacts.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// The stages that a search is made of.
struct SearchStages {
  const PairRule& rule;
  const PairSearch& search;
  const ElementaryTest& elementary;
};

class CandidateSearch {
 public:
  // tree: refitted to the step. clean: by triangle, at t=0. triangle_flags: see pair_rule.h. The
  // references must outlive this object.
  CandidateSearch(const SearchStages& stages, const Topology& mesh, const BoundingVolumeTree& tree,
                  const PositionsView& x_t0, const PositionsView& x_t1,
                  const std::vector<std::uint8_t>& clean, std::vector<std::uint8_t> triangle_flags,
                  const StopFunction& stop);

  // Broad phase: notes the feature pairs of all candidates. Each of these three returns false when
  // `stop` ended it.
  bool collect() { return collect(stages_.rule.candidates()); }
  // Narrow phase: tests what was noted.
  bool test() { return contacts_.run(stop_); }
  // L7. H := the triangles found in contact with their own component (pairs of two components were
  // all tested, and layers count the own component only: L10). Tests (U,H), adds what is found,
  // until H is stable. V0 and Vv were looked at against everything already.
  bool close();

  std::vector<PairContact> pair_contacts() const { return contacts_.pair_contacts(); }
  const SearchCounts& search_counts() const { return counts_; }
  const NarrowCounts& narrow_counts() const { return contacts_.counts(); }
  std::uint64_t closure_rounds() const { return closure_rounds_; }

 private:
  bool collect(const PairTables& tables);
  bool same_component(std::int32_t a, std::int32_t b) const;

  SearchStages stages_;
  const Topology& mesh_;
  const BoundingVolumeTree& tree_;
  const std::vector<std::uint8_t>& clean_;
  const StopFunction& stop_;
  Marks marks_;
  FeatureContacts contacts_;
  SearchCounts counts_;
  std::uint64_t closure_rounds_ = 0;
};

}  // namespace assay::detector
