// K, the pairs among which the first contact is found (L3 and L10, detector/README.md),
// from exact view signs.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// K = (V+,V-) u (U,V0) u (U,Vv): a pair is in K when its signs are opposite, when one of them is
// zero, or when one of its triangles is in Vv; and when its triangles are of two groups (L10).
// U is all triangles. Triangles that share a vertex or an edge are pairs like all others.
class Candidates {
 public:
  // By triangle: signs of all; Vv (touched by a ghost, or dirty) as 0 or 1, or empty for none;
  // groups (components), or empty for one.
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

// L3: some pair of `pairs` with the least time is in `candidates`. True of no pairs.
bool holds_a_first_contact(const std::vector<detector::PairContact>& pairs,
                           const Candidates& candidates);

}  // namespace assay::oracle
