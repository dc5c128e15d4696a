// Compares one step of a detector with the oracle: the diff says how their answers differ, and
// what the candidate pairs of a broad phase lack, and what a limiter allows too much or too little.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"
#include "properties/words.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// What the oracle found in a step, as a contract sees it, and the places of contact at one time.
// Whatever shows or judges a detector's step takes the oracle's facts from here, so that a contract
// is obeyed everywhere (step_truth.cpp).

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
// have to be those of tested_pairs (claims.h). Cost: oracle/mesh/step.h,
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

// refused: beyond the capacity of the contract, where the detector need not answer.
enum class Outcome : std::uint8_t { holds, defect, undecided, error, refused };
constexpr auto names_of(Outcome) {
  using enum Outcome;
  return std::to_array<Named<Outcome>>({{holds, "holds"},
                                        {defect, "defect"},
                                        {undecided, "undecided"},
                                        {error, "error"},
                                        {refused, "refused: capacity"}});
}

// A pair whose first time the detector has wrong.
struct WrongTime {
  detector::TrianglePair pair;
  detector::TimeEnclosure detector, oracle;
};

// How far a stated first time is off, as a share of the step. A time is taken by the lower end of
// its interval, because that is how far the caller goes: it is late if this end is after t*, and
// early if it is before t*, each by more than the tolerance. So [0.25, 1] states a time, and where
// t* is 0.75 it is early by 0.5, although it holds t*. At most one of the two is not 0. Every count
// of late and early first times is one of these (step_errors.h).
struct TimeOff {
  double late = 0, early = 0;
  double ulps = 0;  // how many doubles lie between the two lower ends; 0 if neither late nor early
};
TimeOff time_off(const detector::TimeEnclosure& stated, const detector::TimeEnclosure& exact,
                 double tolerance);

// The first time of the detector and of the oracle, and how far they are apart.
struct FirstTimes {
  detector::TimeEnclosure detector, oracle;
  TimeOff off;
};

// How many candidate pairs the detector gave, and the least possible number: the pairs in contact
// that count.
struct CandidateCount {
  std::uint64_t given = 0, least = 0;
};

// What a limiter allowed in a step that starts without a contact (judge_limit).
struct LimitDiff {
  double share = -1;  // of the step; -1: not stated
  double used = 0;    // the share, or else how much of the way the positions go
  std::optional<detector::TimeEnclosure> ahead;  // the first contact time of the step, if any
  // The first contact on the straight way to where the caller stops.
  std::optional<detector::PairContact> hit;
  bool is_cut = false;      // the step has no contact, and is not gone to its end
  bool is_excused = false;  // less than claimed is gone, and rounding may be why
  std::string stall;  // the caller stays although it could move: the cause of the contact ahead
};

struct StepDiff {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> broken;  // claims of the detector that this step refutes
  detector::Answer answer = detector::Answer::undecided;  // the detector's
  bool oracle_complete = false;                           // false: the oracle was stopped
  bool nothing_in_contact = false;  // by a complete oracle, whatever the contract leaves out
  bool starts_near = false;         // StepTruth::starts_near
  bool claims_pairs = false;        // all-pairs or first-pairs is claimed
  bool unanswered_contact = false;  // a contact that counts, and no answer that can be judged
  // The detector or the oracle was stopped: only what both reached is compared.
  bool partial = false;
  bool answered_free = false;       // `free`, although there is a contact that counts
  bool answered_collision = false;  // `collision`, and there is no contact at all
  // Both answer collision, and the detector's interval does not hold t*, by more than the
  // tolerance: it begins after t*, or ends before it.
  bool late_first = false, early_first = false;
  // Pairs of the oracle that the detector does not report. Empty for a detector that reports no
  // pairs.
  std::vector<detector::PairContact> missing;
  std::vector<detector::PairContact> excused;   // missing, but not claimed
  std::vector<detector::PairContact> spurious;  // reported, but not in contact
  // Pairs whose interval begins after their time, which is unsafe, or ends before it.
  std::vector<WrongTime> late, early;

  // With a slack, the first pair that comes within it, if the detector's first time ends before
  // that.
  std::optional<detector::PairContact> first_in_slack;

  // The earliest contact that counts; nothing if there is none.
  std::optional<detector::PairContact> first_contact;
  // The detector's first time, and the exact one of the contacts that count, if both answer
  // collision.
  std::optional<FirstTimes> first;

  // The answer is wrong, whatever the detector claims.
  bool wrong_answer() const { return answered_free || answered_collision; }
  bool wrong_first_time() const { return late_first || early_first; }

  // Pairs in contact that the contract lets the detector leave out. `left_out_missed`: only
  // because of that leave is the step no miss. If these pairs counted, the answer `free`, or the
  // first time, would be wrong.
  std::vector<detector::PairContact> left_out;
  bool left_out_missed = false;

  // Only for a detector that claims candidates (judge_candidates); nothing if it failed to give
  // them.
  std::optional<CandidateCount> candidates;
  std::vector<detector::PairContact> missing_candidates;
  std::optional<LimitDiff> limit;   // only of a limiter
  bool has_answer = true;           // false: the library gives candidates or limits, no answers
  std::optional<StepLoad> refused;  // only of a step that was refused as beyond the capacity
};

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
// What breaks a claim:
// - free-sound: the answer `free`, although there is a contact.
// - not-late: a first time that is late.
// - first-time: a first time that is late, or whose interval ends before t*.
// - first-pairs: a missing pair without excuse.
// - all-pairs: a missing pair, or a late one.
// - no-spurious: `collision` although there is no contact, a spurious pair, a pair whose time
//   ends before its contact, or, with a margin, a first time that ends before all that comes within
//   the slack.
//
// times-unique breaks nothing by itself. If it is claimed, an interval is wrong unless it is the
// oracle's in every bit.
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
// What breaks a claim; t* is the first contact time of the whole step:
// - commit-free: a contact in the straight step from x_t0 to where the caller stops.
// - path-free: a share that is not below t*.
// - progress: a share below Contract::progress times the least of t* and 1, where rounding cannot
//   be the reason: so much of the step moves some vertex by 2^10 units in its last place or more;
//   the gaps at the start, beyond the separation, are 2^6 units of the largest coordinate or more;
//   and each of eight equal places from that share to t* is free to go to, with its rounding, by
//   the oracle. Elsewhere it is only counted.
// - whole-when-safe: x_t1 is not reached, and the step has no contact.
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
