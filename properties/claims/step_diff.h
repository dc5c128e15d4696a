// How a step of a detector and the oracle differ, what the candidate pairs of a broad phase lack,
// and what a limiter allows too much or too little. Claims are judged by it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/claims/contract.h"
#include "properties/words.h"

namespace assay::properties {

enum class Claim : std::uint8_t;  // claims.h

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
// of late and early first times is one of these (step_measures.h).
struct TimeOff {
  double late = 0, early = 0;
  double ulps = 0;  // how many doubles lie between the two lower ends; 0 if neither late nor early
};

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
  bool too_far = false;     // a share is stated that is not below the first contact time
  bool too_short = false;   // less than claimed is gone, and is_excused is not why
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
  bool owes_answer = false;         // to a valid step within the capacity there is none
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
  bool is_without_excuse = false;               // one of them, even if all-pairs is not claimed
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

// How a step breaks a claim, which is the kind of its failure ("late pair"; null: it does not), and
// by what: a contact of the oracle, one that comes within the slack alone, a pair with a wrong
// time, a pair that is not in contact, or nothing that could be named.
struct WithinSlack {
  detector::PairContact contact;
};
struct Shown {
  const char* kind = nullptr;
  std::variant<std::monostate, detector::PairContact, WithinSlack, WrongTime,
               detector::TrianglePair>
      by = {};
};
// The first that breaks it.
inline Shown operator|(const Shown& a, const Shown& b) { return a.kind ? a : b; }

inline Shown if_so(bool is_so, const char* kind,
                   const std::optional<detector::PairContact>& contact = {}) {
  if (!is_so) return {};
  return contact ? Shown{kind, *contact} : Shown{kind};
}
template <class Wrong>
Shown if_any(const char* kind, const std::vector<Wrong>& list) {
  return list.empty() ? Shown() : Shown{kind, list.front()};
}

}  // namespace assay::properties
