// What a detector promises: its claims, by what a step breaks them, and what else a plug-in says of
// itself. Its contract, under which they hold, is contract.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/options.h"
#include "detector/plugin/assay_detector.h"
#include "properties/claims/contract.h"
#include "properties/words.h"

namespace assay::properties {

// How a step of a detector and the oracle differ, what the candidate pairs of a broad phase lack,
// and what a limiter allows too much or too little. Claims are judged by it.

enum class Claim : std::uint8_t;  // below

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
  std::uint64_t given_pairs = 0, least = 0;
};

// What a limiter allowed in a step that starts without a contact (judge_limit).
struct LimitDiff {
  double share = -1;  // of the step; -1: not stated
  double way = 0;     // the share, or else how much of the way the positions go
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
  std::vector<Claim> breaches;  // claims of the detector that this step refutes
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
  std::vector<detector::PairContact> excuses;   // missing, but not claimed
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
  std::optional<LimitDiff> limit;    // only of a limiter
  bool has_answer = true;            // false: the library gives candidates or limits, no answers
  std::optional<StepLoad> overload;  // only of a step that was refused as beyond the capacity
};

// How a step breaks a claim, which is the kind of its failure ("late pair"; null: it does not), and
// by what: a contact of the oracle, one that comes within the slack alone, a pair with a wrong
// time, a pair that is not in contact, or nothing that could be named.
struct WithinSlack {
  detector::PairContact contact;
};
struct Symptom {
  const char* kind = nullptr;
  std::variant<std::monostate, detector::PairContact, WithinSlack, WrongTime,
               detector::TrianglePair>
      by = {};
};
// The first that breaks it.
inline Symptom operator|(const Symptom& a, const Symptom& b) { return a.kind ? a : b; }

inline Symptom if_so(bool is_so, const char* kind,
                     const std::optional<detector::PairContact>& contact = {}) {
  if (!is_so) return {};
  return contact ? Symptom{kind, *contact} : Symptom{kind};
}
template <class Wrong>
Symptom if_any(const char* kind, const std::vector<Wrong>& list) {
  return list.empty() ? Symptom() : Symptom{kind, list.front()};
}

// What a detector claims of its answers.

// In the list below t* is the first contact time of the step; under a contract with a separation d
// it is the first time within d, and a contact is a pair that comes within d. The contact graph at
// t* has the triangles as nodes, and the pairs that are in contact at t* as edges.
enum class Claim : std::uint8_t {
  free_sound,     // never `free` when the oracle has a contact
  not_late,       // lower end of its first time <= t*
  first_time,     // the interval of its first time holds t*
  first_pairs,    // every connected part of the contact graph at t* holds a reported pair
  all_pairs,      // every pair of the oracle is reported, none with a time after its own
  no_spurious,    // reports no contact that is not there, and none too early
  deterministic,  // the same input gives the same result
  total,          // every valid input within the limits is answered
  candidates,     // every pair of the oracle is among the candidate pairs of its broad phase
  // Of a limiter (L17), in steps that start without a contact.
  commit_free,  // the step to the positions that it allows has no contact
  path_free,    // the share that it allows is below t*
  progress,     // that share is Contract::progress of what is possible or more (judge_limit)
  whole,        // it allows a step without a contact to its very end
  // Every time is the enclosure of exact arithmetic, so it has to be the oracle's in every bit.
  // This is how the other claims on times are read of a detector that claims it. Only the built-in
  // detector does: nobody claims it from outside, and no list names it.
  times_unique,
};

// What a claim is about, and so which part of a library can make it. `runs`: any part can.
enum class About : std::uint8_t { answers, times, pairs, broad_phase, limits, runs };

// What puts a claim to the test.
enum class Probe : std::uint8_t {
  by_step,           // any that is judged
  by_contact,        // a step with a contact that counts
  by_stated_time,    // such a step, where first times are stated
  by_candidates,     // a step with pairs that have to be among them
  by_contact_ahead,  // of a limiter
  by_free_way,       // of a limiter
  by_second_run,     // of the same case
};

// What a detector does that breaks a claim. One change may mend all that do the same.
enum class Deed : std::uint8_t { loses, reports, stops, differs, ends };
constexpr auto names_of(Deed) {
  using enum Deed;
  return std::to_array<Named<Deed>>({{loses, "lose a contact"},
                                     {reports, "report what is not there, or too early"},
                                     {stops, "stop before they have to"},
                                     {differs, "answer otherwise when asked again"},
                                     {ends, "end without an answer"}});
}

// All that there is to know of a claim: who judges it, leaves it out or speaks of it reads it here.
struct ClaimRow {
  Claim value;
  const char* name;
  std::uint32_t bit;    // of assay_description::claims; 0: nobody claims it from outside
  std::uint32_t since;  // the version of the interface in which that bit came
  About about;
  Probe probe;
  Deed deed;
  // How a step breaks it. Two runs alone break `deterministic` (exam.h), and nothing breaks
  // times_unique.
  Symptom (*symptom_of)(const StepDiff&) = [](const StepDiff&) { return Symptom(); };
  // Why it is not judged under this contract; empty if it is.
  const char* (*why_void)(const Contract&, bool of_queries) = [](const Contract&, bool) {
    return "";
  };
};

constexpr auto names_of(Claim) {
  using enum Claim;
  using enum About;
  using enum Probe;
  using enum Deed;
  using C = const Contract&;
  using D = const StepDiff&;
  constexpr auto without_pairs = [](C c, bool) {
    return c.reports_pairs() ? "" : "the detector reports no pairs";
  };
  return std::to_array<ClaimRow>({
      {free_sound, "free-sound", ASSAY_CLAIM_FREE_SOUND, 1, answers, by_contact, loses,
       [](D d) { return if_so(d.answered_free, "answered free", d.first_contact); }},
      {not_late, "not-late", ASSAY_CLAIM_NOT_LATE, 1, times, by_contact, loses,
       [](D d) { return if_so(d.late_first, "late", d.first_contact); }},
      {first_time, "first-time", ASSAY_CLAIM_FIRST_TIME, 1, times, by_stated_time, loses,
       [](D d) {  // an oracle that was stopped knows no exact first time
         return if_so(d.first && d.late_first, "late", d.first_contact) |
                if_so(d.first && d.early_first, "early", d.first_contact);
       },
       [](C c, bool) { return c.margin > 0 ? "the contract has a margin" : ""; }},
      {first_pairs, "first-pairs", ASSAY_CLAIM_FIRST_PAIRS, 1, pairs, by_contact, loses,
       [](D d) { return d.is_without_excuse ? if_any("missing pair", d.missing) : Symptom(); },
       without_pairs},
      {all_pairs, "all-pairs", ASSAY_CLAIM_ALL_PAIRS, 1, pairs, by_contact, loses,
       [](D d) { return if_any("missing pair", d.missing) | if_any("late pair", d.late); },
       without_pairs},
      {no_spurious, "no-spurious", ASSAY_CLAIM_NO_SPURIOUS, 1, answers, by_step, reports,
       [](D d) {
         const auto pair =
             d.spurious.empty() ? Symptom() : Symptom{"spurious pair", d.spurious.front().pair};
         if (d.answered_collision) return Symptom{"answered collision", pair.by};
         return pair | if_any("early pair", d.early) |
                (d.first_in_slack ? Symptom{"early alarm", WithinSlack{*d.first_in_slack}}
                                  : Symptom());
       },
       [](C c, bool of_queries) {
         return c.judges_alarms(of_queries) ? ""
                                            : "the contract has a margin, and tests neighbours";
       }},
      {deterministic, "deterministic", ASSAY_CLAIM_DETERMINISTIC, 1, runs, by_second_run, differs},
      {total, "total", ASSAY_CLAIM_TOTAL, 1, runs, by_step, ends,
       [](D d) { return if_so(d.owes_answer, d.overload ? name_of(Outcome::refused) : "error"); }},
      {candidates, "candidates", ASSAY_CLAIM_CANDIDATES, 2, broad_phase, by_candidates, loses,
       [](D d) { return if_any("missing candidate", d.missing_candidates); }},
      {commit_free, "commit-free", ASSAY_CLAIM_COMMIT_FREE, 3, limits, by_contact_ahead, loses,
       [](D d) {
         return d.limit && d.limit->hit ? Symptom{"contact on the way", *d.limit->hit} : Symptom();
       }},
      {path_free, "path-free", ASSAY_CLAIM_PATH_FREE, 3, limits, by_contact_ahead, loses,
       [](D d) { return if_so(d.limit && d.limit->too_far, "share too large", d.first_contact); }},
      {progress, "progress", ASSAY_CLAIM_PROGRESS, 3, limits, by_contact_ahead, stops,
       [](D d) {
         return if_so(d.limit && d.limit->too_short, "share too small", d.first_contact);
       }},
      {whole, "whole-when-safe", ASSAY_CLAIM_WHOLE, 3, limits, by_free_way, stops,
       [](D d) { return if_so(d.limit && d.limit->is_cut, "free step cut", d.first_contact); }},
      {times_unique, "times-unique", 0, 1, times, by_contact, loses},
  });
}

// A set of claims.
class Claims {
 public:
  constexpr Claims() = default;
  constexpr Claims(std::initializer_list<Claim> claims) {
    for (const Claim claim : claims) bits_ |= bit_of(claim);
  }
  static constexpr Claims of_bits(std::uint32_t bits) {
    Claims claims;
    claims.bits_ = bits;
    return claims;
  }

  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool has(Claim claim) const { return (bits_ & bit_of(claim)) != 0; }
  constexpr bool has_any(const Claims& others) const { return (bits_ & others.bits_) != 0; }
  constexpr Claims& set(Claim claim, bool is_claimed = true) {
    bits_ = is_claimed ? bits_ | bit_of(claim) : bits_ & ~bit_of(claim);
    return *this;
  }
  // Those of them that are also among the others, and those that are not.
  constexpr Claims only(const Claims& others) const { return of_bits(bits_ & others.bits_); }
  constexpr Claims without(const Claims& others) const { return of_bits(bits_ & ~others.bits_); }
  constexpr Claims with(const Claims& others) const { return of_bits(bits_ | others.bits_); }

  friend constexpr bool operator==(const Claims&, const Claims&) = default;

 private:
  static constexpr std::uint32_t bit_of(Claim claim) { return 1u << static_cast<unsigned>(claim); }
  std::uint32_t bits_ = 0;
};

// Those that a detector may claim from outside of these things.
constexpr Claims claims_about(std::initializer_list<About> abouts) {
  Claims claims;
  for (const About about : abouts) {
    for (const auto& row : all_rows<Claim>)
      if (row.about == about) claims = claims.with(Claims::of_bits(row.bit));
  }
  return claims;
}
inline constexpr Claims claims_on_limits = claims_about({About::limits});
inline constexpr Claims claims_from_outside = claims_about(
    {About::answers, About::times, About::pairs, About::broad_phase, About::limits, About::runs});
static_assert(std::all_of(all_rows<Claim>.begin(), all_rows<Claim>.end(), [](const ClaimRow& row) {
  return row_of(row.value).value == row.value &&
         (row.bit == 0 || row.bit == Claims({row.value}).bits());
}));

// What the built-in detector claims. exact: everything. bounded: everything but no-spurious (its
// intervals hold the times by construction, see StepResult::first). double and float:
// deterministic and total. With pairs first, no arithmetic claims all-pairs.
inline Claims claims_of(const detector::Options& options) {
  const bool exact = options.arithmetic == detector::Arithmetic::exact;
  const bool is_proved = exact || options.arithmetic == detector::Arithmetic::bounded;
  Claims claims = {Claim::deterministic, Claim::total};
  if (!is_proved) return claims;
  claims = claims.with({Claim::free_sound, Claim::not_late, Claim::first_time, Claim::first_pairs});
  claims.set(Claim::all_pairs, options.pairs == detector::Pairs::all);
  return claims.set(Claim::no_spurious, exact).set(Claim::times_unique, exact);
}

// Those of claims_from_outside that `claims` has, in the order of Claim.
std::vector<Claim> list_of(const Claims& claims);
// Their words, and the claims of words. A word of no claim is passed over.
std::vector<std::string> words_of(const Claims& claims);
Claims claims_named(const std::vector<std::string>& words);

// The progress that the built-in detector promises where it limits a step.
inline constexpr double built_in_progress = 0.9;

// What the built-in detector is asked with these options: contact, or within a separation of pairs
// that share no vertex.
Contract contract_of(const detector::Options& options);

// The claims that are judged under this contract (ClaimRow::why_void). If it has a margin, the
// detector may report a collision before there is one; its false alarms are judged with the margin
// of queries, and of steps if it leaves neighbours out.
Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries = false);

// Adds to `breaches` those of the claims that the step breaks, and makes it a defect if one is.
void weigh(const Claims& claims, StepDiff& diff);

// What a plug-in says of itself.

// What a library can do. The defaults are those of the built-in detector, which answers steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool limit = false;
  bool takes_threads = false;  // it has a function by which it is told how many threads it may use
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// What keeps a text from being the name of a detector, or its version: it is longer than 100 bytes,
// begins or ends with a space, or is the name of the built-in detector. Empty if nothing does.
std::string fault_of_name(std::string_view name);

// What is wrong with what it says of a limiter: claims without one, one without claims, or a claim
// on progress without Contract::progress. Empty if nothing is.
std::string fault_of_limits(const Claims& claims, const Contract& contract, bool has_limit);

// Those of its claims that can be judged by playing steps. These are all that it makes, or, for a
// library that answers no steps, those of candidates, limits, deterministic and total.
Claims claims_on_steps(const PluginDescription& description);
// Those of its claims that can be judged by asking its query: all that it makes except those about
// pairs, candidates and limits.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
