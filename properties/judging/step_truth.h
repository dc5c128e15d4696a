// What the oracle found in a step, as a contract sees it, and the places of contact at one time.
// Whatever shows or judges a detector's step takes the oracle's facts from here, so that a contract
// is obeyed everywhere.
#pragma once

#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/step.h"
#include "properties/claims/contract.h"

namespace assay::properties {

struct StepTruth {
  // The pairs that count, ascending, each with the first time at which it does.
  std::vector<detector::PairContact> pairs;
  // The contacts that the contract lets the detector leave out, ascending: pairs of neighbours, and
  // pairs that touch in features that it does not test. A pair that counts only later stands in
  // both lists, here with its first time of all.
  std::vector<detector::PairContact> left_out;
  // The earliest of `pairs`; an upper bound if the judgement is not complete.
  std::optional<detector::PairContact> first;
  bool complete = false;  // false: the oracle was stopped

  // Of the contacts that count.
  detector::Answer answer() const;
};

// REQUIRES a judgement of the oracle that was asked for asked_features(contract) (agreement.h).
// O(n) in the number of pairs.
StepTruth truth_of(const oracle::StepJudgement& judgement, const Contract& contract,
                   const detector::TrianglesView& triangles);

using ContactPart = std::vector<detector::PairContact>;

// The connected parts of the contact graph, each with its pairs. Triangles are nodes, and the
// pairs whose first time is `time` are edges. Two times that share an enclosure count as one;
// parts may then be joined, but never split. O(n log n).
std::vector<ContactPart> contact_parts(const std::vector<detector::PairContact>& pairs,
                                       const detector::TimeEnclosure& time);

}  // namespace assay::properties
