// The diff of one step: what a detector answered against what the oracle found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_names.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"

namespace assay::properties {

enum class Outcome : std::uint8_t { holds, defect, undecided, error };

const char* name_of(Outcome outcome);
using corpus::name_of;  // of detector::Answer
const char* name_of(detector::FeatureKind kind);

// A pair whose first time the detector has wrong.
struct WrongTime {
  detector::TrianglePair pair;
  detector::TimeEnclosure detector, oracle;
};

// Two first times, and by which share of the step the detector's interval begins after the exact
// time or ends before it: 0 where it does neither.
struct FirstTimes {
  detector::TimeEnclosure detector, oracle;
  double late_by = 0, early_by = 0;
};

// How many candidate pairs there are, and how many pairs that count are in contact: the least
// possible.
struct CandidateCount {
  std::uint64_t given = 0, least = 0;
};

struct StepDiff {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> broken;   // claimed, and refuted by this step
  bool partial = false;        // detector or oracle was stopped: only what both reached is compared
  bool answered_free = false;  // against a contact that counts
  bool answered_collision = false;               // against none at all
  bool late_first = false, early_first = false;  // collision at both, by more than the tolerance
  // Of the oracle, not of the detector. Empty for a detector that reports no pairs.
  std::vector<detector::PairContact> missing;
  std::vector<detector::PairContact> excused;   // missing, but outside of what is claimed
  std::vector<detector::PairContact> spurious;  // of the detector, not of the oracle
  std::vector<WrongTime> late, early;           // late is unsafe

  // Of what counts, the earliest contact; nothing where there is none.
  std::optional<detector::PairContact> first_contact;
  // The detector's first time and the exact one of what counts, where both answer collision.
  std::optional<FirstTimes> first;

  // Whether it is a wrong answer, whatever is claimed.
  bool wrong_answer() const { return answered_free || answered_collision; }
  bool wrong_first_time() const { return late_first || early_first; }

  // Pairs in contact that the contract lets the detector leave out, and whether the leave is what
  // saves the step from being a miss: else `free`, or the first time, would be wrong.
  std::vector<detector::PairContact> left_out;
  bool left_out_missed = false;

  // Of a detector that claims candidates (candidate_check.h); nothing where it failed to give them.
  std::optional<CandidateCount> candidates;
  std::vector<detector::PairContact> missing_candidates;
  bool has_answer = true;  // false: of a library of candidates alone
};

// Judges a step by what its detector claims. The oracle's pairs outside of the contract's
// adjacency and features do not count against the detector, and its first time t* is that of the
// others; a reported one of them is not spurious. The detector's times are intervals: right when
// they hold the oracle's time, late when they begin after it, each by more than the contract's
// tolerance (compared in doubles: a tolerance of 0 exactly, another to 1e-16). A missing pair is
// excused, where all-pairs is not claimed, when it is later than t* or when its part of the
// contact graph at t* (triangles as nodes, pairs in contact at t* as edges) holds a reported pair.
// With a margin no-spurious is not judged. A step that was answered by an error breaks `total`, or
// is Outcome::error where that is not claimed. `deterministic` needs two runs: same_answers. O(n
// log n) in the number of pairs.
//
// What breaks a claim. free-sound: `free` against a contact. not-late: a first time that is late.
// first-time: a first time that is wrong. first-pairs: a missing pair without excuse. all-pairs: a
// missing or late pair. no-spurious: `collision` against none, a spurious or an early pair.
//
// REQUIRES a judgement by asked_features(contract).
StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 const Claims& claims, const Contract& contract,
                 const detector::TrianglesView& triangles);

// What the oracle is asked for under this contract.
oracle::AskedFeatures asked_features(const Contract& contract);

// The built-in detector, by claims_of(options): in exact arithmetic its times are unique
// enclosures, so each must agree in every bit; in others they are intervals. An input error is
// Outcome::error.
StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 const detector::Options& options);
// The same in exact arithmetic.
StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 detector::Pairs claimed);

// At which stage of the detector a pair that it misses was lost, found by running the step with
// less culling: "view sets" when culling bvh finds it, "pair search" when only culling none does
// (tried for meshes of up to 2,000 triangles), "elementary test" when neither does.
std::string stage_that_lost(const detector::TrianglesView& triangles,
                            const detector::PositionsView& x_t0,
                            const detector::PositionsView& x_t1, detector::TrianglePair pair);

}  // namespace assay::properties
