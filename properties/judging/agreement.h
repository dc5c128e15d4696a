// Compares one step of a detector with the oracle: the diff says how their answers differ, which
// pairs the candidates of a broad phase lack, and whether a limiter allows too much or too little.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "oracle/instant/instant.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

using oracle::JudgeOptions, oracle::StepJudgement;

// The oracle's facts about a step, as a contract sees them, and the places of contact at one time.
// All code that shows or judges a detector's step takes these facts from here, so that a contract
// is obeyed everywhere.

struct StepTruth {
  // The pairs that count, ascending, each with the first time at which it counts.
  std::vector<PairContact> pairs;
  // The contacts that the contract lets the detector leave out, ascending: pairs of neighbours, of
  // its own rings and distance at rest, and pairs that touch in features that it does not test. A
  // pair that counts only later stands in both lists, here with its first time of all. Pairs that
  // the relation of the case leaves out stand in neither list.
  std::vector<PairContact> left_out;
  // The earliest of `pairs`; an upper bound if the judgement is not complete.
  std::optional<PairContact> first;
  // The contract has a separation, and a pair that counts is within it at t = 0. Such a step does
  // not show how the detector finds a time.
  bool starts_near = false;
  bool complete = false;  // false: the oracle was stopped

  // Returns the answer by the contacts that count.
  Answer answer() const;
};

// Asks the oracle about a step under this contract: which triangles touch or, if the contract has a
// separation, come within it; with a margin also which pairs come within separation + margin. The
// result still has the contacts that the contract leaves out; truth_of separates them. Under a
// separation, pairs that share a vertex are not asked for. The features are the contract's,
// whatever `options` says; the tested pairs of `options` must be those of tested_pairs
// (contract.h). Cost: oracle/mesh/step.h, oracle/distance/step_distance.h.
StepJudgement judge_under(const Contract& contract, const SteppedMesh& motion,
                          const TrianglesView& triangles, JudgeOptions options = {});

// Returns the facts. REQUIRES a judgement by judge_under this contract. O(number of pairs).
StepTruth truth_of(const StepJudgement& judgement, const Contract& contract,
                   const TrianglesView& triangles);

using ContactPart = std::vector<PairContact>;

// Returns the connected parts of the contact graph, each with its pairs. Triangles are nodes, and
// the pairs whose first time is `time` are edges. Two times with the same enclosure count as one;
// parts may then be joined, but never split. O(n log n).
std::vector<ContactPart> contact_parts(const std::vector<PairContact>& pairs,
                                       const TimeEnclosure& time);

TimeOff time_off(const TimeEnclosure& interval, const TimeEnclosure& exact, double tolerance);

// Judges a step by the claims of its detector. Pairs of the oracle that lie outside of the
// contract's adjacency and features do not count against the detector: its first time is compared
// with t*, the first time of the other pairs. If the detector reports such a pair, the pair is not
// spurious. Only under a separation a pair that shares a vertex is spurious, because it is not
// asked for.
//
// The detector's times are intervals. An interval is wrong if it does not hold the oracle's time:
// if it begins after that time, or ends before it, each by more than the contract's tolerance
// (compared in doubles: a tolerance of 0 exactly, another to 1e-16).
//
// Without the claim all-pairs a missing pair is excused in two cases: it is first in contact after
// t*, or its connected part of the contact graph at t* holds a reported pair. That graph has
// triangles as nodes, and pairs in contact at t* as edges.
//
// If the contract has a margin, first-time is not judged, and no-spurious is judged by the pairs
// that come within separation + margin (StepJudgement::within_slack); without these pairs it is not
// judged. A step that was answered by an error breaks `total`, or is Outcome::error if `total` is
// not claimed. It is Outcome::error too if the built-in detector refuses the input by name
// (StepResult::problem), because `total` speaks of valid input. `deterministic` is not judged here,
// because it needs two runs: same_answers. O(n log n) in the number of pairs.
//
// The row of a claim says what breaks it (claims.h). If times-unique is claimed, an interval is
// wrong unless every bit is that of the oracle's interval.
//
// REQUIRES a judgement of the oracle by judge_under, and the triangles if the contract leaves out
// neighbours.
StepDiff compare(const StepResult& result, const StepJudgement& judgement, const Claims& claims,
                 const Contract& contract = {}, const TrianglesView& triangles = Triangles(0, 3));

// Returns which pairs of triangles count under the contract and under each relation of `all`, where
// nullptr stands for no relation. The arguments must outlive the result.
oracle::WantedPair counted_under(const Contract& contract, const TrianglesView& triangles,
                                 std::initializer_list<const CountedPairs*> all);

// Returns the stage at which the detector with these options lost a pair. It runs the step with
// less culling: the stage is "view sets" if Culling::bvh finds the pair, "pair search" if only
// Culling::none does, "elementary test" if neither does. Culling::none is tried on meshes of up to
// 2,000 triangles; for a larger one the answer is "pair search or elementary test".
std::string stage_that_lost(const TrianglesView& triangles, const PositionsView& x_t0,
                            const PositionsView& x_t1, TrianglePair pair, Options options = {});

// A step that is judged, with all that its judgement needs. `options` say which pairs count and are
// tested; a limiter's way is judged by them. REQUIRES a judgement by judge_under.
struct JudgedStep {
  SteppedMesh motion;
  TrianglesView triangles;
  const JudgeOptions& options;
  const StepJudgement& judgement;
  const Claims& claims;
  const Contract& contract;
  StepTruth truth() const { return truth_of(judgement, contract, triangles); }
};

// Returns the diff of the step at this place of the run: of its answer (compare), its candidates
// and its limit (judge_limit). REQUIRES a run that has this step.
//
// Each pair in contact that counts under the contract must be among the candidates, if they are
// claimed. If none were given, or the oracle was stopped, a step that would hold is undecided.
//
// A step that was refused as beyond the capacity has the outcome `refused` if a number of the
// contract's capacity is exceeded, and undecided if the oracle was stopped before it had counted
// that far. Else it breaks `total`, or is an error without that claim.
//
// A step of a library that gives candidates or limits but no answers holds, or was an error, which
// breaks `total`. O(n) in the numbers of pairs and candidates.
StepDiff judge_step(const CaseRun& run, std::size_t place, const JudgedStep& step);

// Judges the limit of a step and adds the result to its diff. A step that starts in contact, or
// within the separation of the contract, is not judged. The judgement is of the whole step under
// the contract. If the limiter stops short of x_t1, the oracle is asked once more, about the step
// from x_t0 to that place. If the oracle was stopped, a step that would hold is undecided.
//
// Let t* be the first contact time of the whole step, or 1 if there is no contact. A share below
// Contract::progress * t* is too short if rounding cannot be the reason, that is, if
//   that part of the step moves some vertex by 2^10 units in its last place or more,
//   the gaps at the start exceed the separation by 2^6 units of the largest coordinate or more, and
//   the oracle finds the way free to each of eight rounded places, equally spaced up to t*.
// Otherwise the share is only counted.
void judge_limit(const std::optional<LimitAnswer>& answer, const JudgedStep& step, StepDiff& diff);

}  // namespace assay::properties
