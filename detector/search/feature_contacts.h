// Narrow phase: from candidate triangle pairs to the contacts of their feature pairs.
//
// A feature pair is tested once, however many candidate triangle pairs share it, and its contact
// is then reported for ALL triangle pairs that hold it, candidates or not. A triangle pair with 0,
// 1 or 2 common vertices has 6 VF + 9 EE, 4 VF + 5 EE or 2 VF + 2 EE feature pairs without a common
// vertex, and (at t=0 only) 6, 2 or 0 edges that may pierce the other triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/contact/elementary_test.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// One contact of a feature pair.
struct FeatureContact {
  Feature feature;
  TimeEnclosure time;               // {0, 0} when only yes or no was wanted
  std::vector<TrianglePair> pairs;  // all that hold the two features
};

struct NarrowCounts {
  std::uint64_t elementary_tests = 0;  // feature pairs tested beyond rung 0, each once
  ContactRungCounts rungs;  // `axis`: once for each candidate pair that held the feature pair
};

class FeatureContacts {
 public:
  // The references and views must outlive this object.
  FeatureContacts(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
                  const ElementaryTest& elementary, Want want);

  // Notes the feature pairs of a candidate pair; `may_pierce`: also those of piercing at t=0.
  void add_candidate(std::int32_t a, std::int32_t b, bool may_pierce);

  // Tests what was added since the last run and not before it, in an order that depends on the
  // mesh alone. Returns false when `stop` asked for an end; contacts found until then are kept.
  bool run(const StopFunction& stop);

  const std::vector<FeatureContact>& contacts() const { return contacts_; }
  const NarrowCounts& counts() const { return counts_; }

  // Least time of each triangle pair, ascending by pair.
  std::vector<PairContact> pair_contacts() const;

 private:
  void note(std::uint64_t key);
  void compact();
  void test(std::uint64_t key);
  FourPoints query(std::uint64_t key) const;

  const Topology& mesh_;
  PositionsView x_t0_, x_t1_;
  const ElementaryTest& elementary_;
  Want want_;
  std::vector<std::uint64_t> noted_;   // since the last run, with repetitions
  std::vector<std::uint64_t> tested_;  // ascending
  std::size_t compact_at_;
  std::vector<FeatureContact> contacts_;
  NarrowCounts counts_;
};

}  // namespace assay::detector
