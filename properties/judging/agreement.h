// Compares one step of a detector with the oracle: the diff says how their answers differ, and
// what the candidate pairs of a broad phase lack, and what a limiter allows too much or too little.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/options.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// What the oracle found in a step, as a contract sees it, and the places of contact at one time.
// Whatever shows or judges a detector's step takes the oracle's facts from here, so that a contract
// is obeyed everywhere.

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

TimeOff time_off(const detector::TimeEnclosure& interval, const detector::TimeEnclosure& exact,
                 double tolerance);

// Judges a step by what its detector claims. Pairs of the oracle that lie outside of the
// contract's adjacency and features do not count against the detector: its first time is compared
// with t*, the first time of the other pairs. If the detector does report such a pair, it is not
// spurious. Under a separation it is: pairs that share a vertex are then not asked for.
//
// The detector's times are intervals. An interval is wrong if it does not hold the oracle's time:
// if it begins after that time, or ends before it, each by more than the contract's tolerance
// (compared in doubles: a tolerance of 0 exactly, another to 1e-16).
//
// A missing pair is excused if all-pairs is not claimed and one of two things holds: the pair is
// in contact later than t* only, or its part of the contact graph at t* (triangles as nodes, pairs
// in contact at t* as edges) holds a reported pair.
//
// If the contract has a margin, first-time is not judged, and no-spurious goes by what comes within
// separation + margin (StepJudgement::within_slack), or is not judged without that. A step that was
// answered by an error breaks `total`, or is Outcome::error if `total` is not claimed. It is
// Outcome::error too if the built-in detector refuses the input by name (StepResult::problem),
// because `total` speaks of valid input. `deterministic` is not judged here, because it needs two
// runs: same_answers. O(n log n) in the number of pairs.
//
// What breaks a claim says its row (claims.h). If times-unique is claimed, an interval is wrong
// unless it is the oracle's in every bit.
//
// REQUIRES a judgement of the oracle that was asked for asked_features(contract), and the triangles
// if the contract leaves out neighbours.
StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 const Claims& claims, const Contract& contract = {},
                 const detector::TrianglesView& triangles = detector::Triangles(0, 3));

// The features that the oracle is to be asked for under this contract.
oracle::AskedFeatures asked_features(const Contract& contract);

// The stage at which the detector with these options lost a pair. It is found by running the step
// with less culling: "view sets" if culling bvh finds the pair, "pair search" if only culling none
// does, "elementary test" if neither does. Culling none is tried for meshes of up to 2,000
// triangles; for a larger one the answer is "pair search or elementary test".
std::string stage_that_lost(const detector::TrianglesView& triangles,
                            const detector::PositionsView& x_t0,
                            const detector::PositionsView& x_t1, detector::TrianglePair pair,
                            detector::Options options = {});

// Adds to the diff of a step what its candidates show: each pair in contact that counts under the
// contract has to be among them. If there are none, or the oracle was stopped, a step that would
// hold is undecided. REQUIRES a judgement by asked_features(contract). O(n) in both numbers of
// pairs.
void judge_candidates(const CandidatePairs& candidates, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles, StepDiff& diff);

// The step that a limiter is asked about. `options` say which pairs count and are tested.
struct LimitedStep {
  detector::SteppedMesh motion;
  const detector::TrianglesView& triangles;
  const oracle::JudgeOptions& options;
};

// Adds to the diff of a step what its limit shows. Nothing is judged of a step that starts in
// contact, or within the separation of the contract. `judgement` is of the whole step under the
// contract. Where the limiter stops short of x_t1 the oracle is asked once more, about the step
// from x_t0 to there. If it was stopped, a step that would hold is undecided.
//
// The share is too short if it is below Contract::progress times t*, the least of 1 and the first
// contact time of the whole step, where rounding cannot be the reason: so much of the step moves
// some vertex by 2^10 units in its last place or more; the gaps at the start, beyond the
// separation, are 2^6 units of the largest coordinate or more; and each of eight equal places from
// that share to t* is free to go to, with its rounding, by the oracle. Else it is only counted.
void judge_limit(const std::optional<LimitAnswer>& answer, const LimitedStep& step,
                 const oracle::StepJudgement& judgement, const Claims& claims,
                 const Contract& contract, StepDiff& diff);

// The diff of a step that was refused as beyond the capacity. It is Outcome::refused where a number
// of the contract's capacity is exceeded. Elsewhere it breaks `total`, or is Outcome::error without
// that claim. It is undecided if the oracle was stopped before it had counted as much.
StepDiff diff_of_refusal(const oracle::StepJudgement& judgement, const Claims& claims,
                         const Contract& contract, const detector::TrianglesView& triangles);

// The diff of a step of a library without answers, of candidates or limits: it holds, or was an
// error, which breaks `total`.
StepDiff diff_without_answer(const detector::StepResult& result,
                             const oracle::StepJudgement& judgement, const Claims& claims,
                             const Contract& contract, const detector::TrianglesView& triangles);

}  // namespace assay::properties
