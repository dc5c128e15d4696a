// K, the pairs among which the first contact is found (L3 and L10, detector/README.md),
// from exact view signs.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// K = (V+,V-) u (U,V0) u (U,Vv), where U is all triangles, and with groups every pair of two
// groups too (L10). So a pair is in K when its signs are opposite, when a sign is zero, when a
// triangle is in Vv, or when its triangles are of two groups. Triangles that share a vertex or an
// edge are pairs like all others.
class Candidates {
 public:
  // Each list is by triangle. `violated` is 1 for a triangle of Vv (dirty, or touched by a ghost),
  // else 0; it may be empty if Vv is. `groups` holds components; it may be empty if all are of one
  // group.
  Candidates(std::vector<detector::ViewSign> signs, std::vector<std::uint8_t> violated,
             std::vector<std::int32_t> groups = {});

  bool holds(const detector::TrianglePair& pair) const;

 private:
  std::vector<detector::ViewSign> signs_;
  std::vector<std::uint8_t> violated_;
  std::vector<std::int32_t> groups_;
};

struct PairSplit {
  std::vector<detector::PairContact> in_k, outside;  // in the order given
};

PairSplit split(const std::vector<detector::PairContact>& pairs, const Candidates& candidates);

// What L3 promises: some pair of `pairs` with the least time is in `candidates`. True if there are
// no pairs.
bool holds_a_first_contact(const std::vector<detector::PairContact>& pairs,
                           const Candidates& candidates);

}  // namespace assay::oracle
