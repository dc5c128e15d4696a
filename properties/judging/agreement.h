// Compares a detector's answer to one step with the oracle's answer. The diff says how the two
// answers differ, which pairs the candidates of a broad phase lack, and whether a limiter allows
// too much or too little.
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

// The oracle's facts about a step, as the contract of a detector sees them. All code that shows or
// judges a step of a detector uses these facts, so that the contract is obeyed everywhere.
struct StepTruth {
  // The pairs that count, ascending, each with the first time at which it counts.
  std::vector<PairContact> pairs;
  // The contacts that the contract lets the detector leave out, ascending: pairs of neighbours,
  // pairs left out by Contract::rings or rest_distance, and pairs that touch only in features that
  // the detector does not test. A pair that does not count when it first touches, but counts later
  // in the step, is in both lists; left_out states the time of its first touch. Pairs that the
  // relation of the case leaves out are in neither list.
  std::vector<PairContact> left_out;
  // The earliest of `pairs`. If the judgement is not complete, its time is an upper bound.
  std::optional<PairContact> first;
  // The contract has a separation, and a pair that counts is within the separation at t = 0. Such a
  // step does not show how well the detector finds a time.
  bool starts_near = false;
  bool complete = false;  // false: the oracle was stopped

  // Returns the answer by the contacts that count.
  Answer answer() const;
};

// Returns the oracle's judgement of a step under this contract: the triangles that touch, or, if
// the contract has a separation, the triangles without a shared vertex that come within the
// separation. If the contract has a margin and judges_alarms(), the judgement also has the pairs
// that come within separation + margin. Contacts that the contract leaves out are included;
// truth_of separates these. The features are those of the contract, whatever `options` says.
// REQUIRES options.tested made by tested_pairs (contract.h). Cost: oracle/mesh/step.h,
// oracle/distance/step_distance.h.
StepJudgement judge_under(const Contract& contract, const SteppedMesh& motion,
                          const TrianglesView& triangles, JudgeOptions options = {});

// Returns the facts about a step. REQUIRES a judgement by judge_under with this contract. O(number
// of pairs).
StepTruth truth_of(const StepJudgement& judgement, const Contract& contract,
                   const TrianglesView& triangles);

using ContactPart = std::vector<PairContact>;

// Returns the connected parts of the contact graph, each as the list of its edges. Triangles are
// nodes, and the pairs whose first time is `time` are edges. Two times with the same enclosure
// count as equal, which can join two parts, but never splits a part. O(n log n).
std::vector<ContactPart> contact_parts(const std::vector<PairContact>& pairs,
                                       const TimeEnclosure& time);

TimeOff time_off(const TimeEnclosure& interval, const TimeEnclosure& exact, double tolerance);

// Returns the diff of a step, judged by the claims of the detector. ClaimRow says what breaks a
// claim (claims.h).
//
// Pairs of the oracle that the contract leaves out (StepTruth::left_out) do not count against the
// detector: its first time is compared with t*, the first time of the remaining pairs. If the
// detector reports a left-out pair, the pair is not spurious. But under a separation a reported
// pair that shares a vertex is spurious, because such pairs are not asked for.
//
// The detector's times are intervals. An interval is wrong if it begins after the oracle's time, or
// ends before this time, by more than the contract's tolerance. The comparison is in doubles: it is
// exact for a tolerance of 0, and right to 1e-16 for any other tolerance. If times-unique is
// claimed, an interval is wrong if any bit differs from the oracle's interval.
//
// If all-pairs is not claimed, a missing pair is excused in two cases: the pair is first in contact
// after t*, or its connected part of the contact graph at t* (contact_parts) holds a reported pair.
//
// If the contract has a margin, first-time is not judged, and no-spurious is judged by the pairs
// that come within separation + margin (StepJudgement::within_slack); if the judgement lacks these
// pairs, no-spurious is not judged. A step that was answered by an error breaks `total`, or is
// Outcome::error if `total` is not claimed. If the built-in detector refuses the input with a named
// problem (StepResult::problem), the step is always Outcome::error, because `total` speaks of valid
// input.
// `deterministic` is not judged here, because it needs two runs (same_answers).
//
// O(n log n) in the number of pairs. REQUIRES a judgement by judge_under, and, if the contract
// leaves out neighbours, the triangles.
StepDiff compare(const StepResult& result, const StepJudgement& judgement, const Claims& claims,
                 const Contract& contract = {}, const TrianglesView& triangles = Triangles(0, 3));

// Returns a function that says whether a pair of triangles counts under the contract's adjacency
// and under each relation of `all`; nullptr there stands for no relation. The arguments must
// outlive the result.
oracle::WantedPair counted_under(const Contract& contract, const TrianglesView& triangles,
                                 std::initializer_list<const CountedPairs*> all);

// Returns the stage at which the detector with these options lost a pair. Runs the step with less
// culling to find out: the stage is "view sets" if Culling::bvh finds the pair, "pair search" if
// only Culling::none finds the pair, and "elementary test" if neither finds the pair. On meshes of
// more than 2,000 triangles Culling::none is not tried; the stage is then "pair search or
// elementary test".
std::string stage_that_lost(const TrianglesView& triangles, const PositionsView& x_t0,
                            const PositionsView& x_t1, TrianglePair pair, Options options = {});

// A step to be judged, and the inputs of judge_step. `options` are the options of the oracle's
// judgement; the way that a limiter allows is judged with the same options. REQUIRES a judgement by
// judge_under.
struct JudgedStep {
  SteppedMesh motion;
  TrianglesView triangles;
  const JudgeOptions& options;
  const StepJudgement& judgement;
  const Claims& claims;
  const Contract& contract;
  StepTruth truth() const { return truth_of(judgement, contract, triangles); }
};

// Returns the diff of the step at this place of the run: for its answer (compare), for its
// candidates and for its limit (judge_limit). REQUIRES a run that has this step.
//
// If the detector claims candidates, each pair in contact that counts under the contract must be
// among the candidates. If the detector gave no list of candidates, or the oracle was stopped, a
// step that breaks no claim is undecided.
//
// A step that the detector refused as beyond its capacity is Outcome::refused if the step exceeds a
// number of the contract's capacity. It is undecided if the oracle was stopped, because its counts
// are then incomplete. Otherwise it breaks `total`, or is Outcome::error if `total` is not claimed.
//
// If a library gives candidates or limits, but no answers, a step in which the library reports an
// error breaks `total`; the answer of any other step breaks no claim. O(n) in the numbers of pairs
// and candidates.
StepDiff judge_step(const CaseRun& run, std::size_t place, const JudgedStep& step);

// Judges the answer of a limiter to a step and adds the result to the diff. A step that starts in
// contact, or within the separation of the contract, is not judged. step.judgement is about the
// whole step. If the limiter stops before x_t1, the oracle also judges the step from x_t0 to the
// place of the stop. If the oracle was stopped, a step that breaks no claim is undecided.
//
// Let t* be the first contact time of the whole step, or 1 if there is no contact. A share below
// p = Contract::progress * t* is too short if rounding cannot be the reason, that is, if
//   the share p of the step moves some coordinate by 2^10 units in its last place or more,
//   the gaps at t=0 exceed the separation by 2^6 units in the last place of the largest coordinate
//   or more, and
//   the oracle finds no contact on the way to any of eight places, which are equally spaced from p
//   on towards t*, and rounded as the caller rounds.
// Otherwise the share is only counted (LimitDiff::is_excused).
void judge_limit(const std::optional<LimitAnswer>& answer, const JudgedStep& step, StepDiff& diff);

}  // namespace assay::properties
