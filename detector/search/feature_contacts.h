// Narrow phase: from candidate triangle pairs to the contacts of their feature pairs.
//
// A feature pair is tested once, however many candidate triangle pairs share it (feature_pairs.h),
// and its contact is then reported for ALL triangle pairs that hold it, candidates or not. A
// triangle pair with 0, 1 or 2 common vertices has 6 VF + 9 EE, 4 VF + 5 EE or 2 VF + 2 EE feature
// pairs without a common vertex, and (at t=0 only) 6, 2 or 0 edges that may pierce the other
// triangle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "detector/contact/elementary.h"
#include "detector/mesh/pair_contacts.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/topology.h"
#include "detector/search/feature_pairs.h"

namespace assay::detector {

class FeatureContacts {
 public:
  // The references and views must outlive this object. With these types (feature_pairs.h) or, where
  // all triangles are of one type and all pairs are asked for, without. Of no use where `pace` was
  // stopped.
  FeatureContacts(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
                  const ElementaryTest& elementary, Want want,
                  const Representatives& representatives, const std::vector<TriangleType>& types,
                  PacedStop* pace = nullptr);
  FeatureContacts(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
                  const ElementaryTest& elementary, Want want, PacedStop* pace = nullptr);
  ~FeatureContacts();
  FeatureContacts(const FeatureContacts&) = delete;
  FeatureContacts& operator=(const FeatureContacts&) = delete;

  // The candidates to come are those of a search that asks for these types.
  void ask(const AskedTypes& asked) { pairs_.ask(asked); }

  // Candidates come in lanes (parallel/workers.h): as many as this says, at first one.
  void make_lanes(std::size_t count);

  // Takes the feature pairs of a candidate pair; `may_pierce`: also those of piercing at t=0. Tests
  // what has come together now and then. Returns false when `stop` asked for an end. Calls for
  // several lanes may run at the same time.
  bool add_candidate(std::int32_t a, std::int32_t b, bool may_pierce, const StopFunction& stop = {},
                     std::size_t lane = 0);

  // Tests what is left, by the workers of `pace` where it has some. Returns false when `stop` asked
  // for an end; contacts found until then are kept.
  bool run(const StopFunction& stop, const PacedStop* pace = nullptr);

  // Triangle pairs in contact that were found since this was last asked, each once.
  std::deque<TrianglePair> take_new_pairs() { return contacts_.take_new_pairs(); }
  NarrowCounts counts() const;
  // Of the tests, in milliseconds: of several lanes the mean.
  double test_time() const;

  // The first contact of each triangle pair, ascending by pair; {0, 0} is its time when only yes or
  // no was wanted. Nothing is left behind.
  std::vector<PairContact> take() { return contacts_.take(); }

 private:
  struct OneType;  // what the short constructor makes for itself
  FeatureContacts(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
                  const ElementaryTest& elementary, Want want, std::unique_ptr<OneType> own,
                  PacedStop* pace);
  // What one lane has taken and found.
  struct Lane {
    std::vector<FeatureKey> untested;
    std::vector<PairContact> found;  // and not yet among the contacts
    NarrowCounts counts;
    double test_time = 0;
  };
  bool run(Lane& lane, const StopFunction& stop);
  void test(FeatureKey key, Lane& lane) const;
  bool hand_over(Lane& lane, const StopFunction& stop);
  FourPoints query(FeatureKey key) const;

  const Topology& mesh_;
  PositionsView x_t0_, x_t1_;
  const ElementaryTest& elementary_;
  Want want_;
  std::unique_ptr<OneType> own_;
  FeaturePairs pairs_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::mutex handing_over_;
  PairContacts contacts_;
};

}  // namespace assay::detector
