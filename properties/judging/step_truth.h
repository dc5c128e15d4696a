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
  // The contacts that the contract lets the detector leave out, ascending: pairs of neighbours, of
  // its own rings and distance at rest, and pairs that touch in features that it does not test. A
  // pair that counts only later stands in both lists, here with its first time of all. What the
  // relation of the case leaves out stands in neither list.
  std::vector<detector::PairContact> left_out;
  // The earliest of `pairs`; an upper bound if the judgement is not complete.
  std::optional<detector::PairContact> first;
  // The contract has a separation, and something that counts is within it at t = 0. Such a step
  // says nothing about how the detector finds a time.
  bool starts_near = false;
  bool complete = false;  // false: the oracle was stopped

  // Of the contacts that count.
  detector::Answer answer() const;
};

// What the oracle says of a step under this contract: which triangles touch or, if the contract has
// a separation, which come within it; with a margin also what comes within separation + margin.
// What the contract leaves out is among it: truth_of takes it out. Under a separation, pairs that
// share a vertex are not asked for. Of `options` the features are the contract's; the tested pairs
// have to be those of tested_pairs (contract.h). Cost: oracle/mesh/step.h,
// oracle/distance/step_distance.h.
oracle::StepJudgement judge_under(const Contract& contract, const detector::SteppedMesh& motion,
                                  const detector::TrianglesView& triangles,
                                  oracle::JudgeOptions options = {});

// REQUIRES a judgement by judge_under this contract. O(n) in the number of pairs.
StepTruth truth_of(const oracle::StepJudgement& judgement, const Contract& contract,
                   const detector::TrianglesView& triangles);

using ContactPart = std::vector<detector::PairContact>;

// The connected parts of the contact graph, each with its pairs. Triangles are nodes, and the
// pairs whose first time is `time` are edges. Two times that share an enclosure count as one;
// parts may then be joined, but never split. O(n log n).
std::vector<ContactPart> contact_parts(const std::vector<detector::PairContact>& pairs,
                                       const detector::TimeEnclosure& time);

}  // namespace assay::properties
