// The claims of a detector, how a step breaks them, and the description that a plug-in gives of
// itself. The contract under which claims hold is in contract.h.
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

#include "detector/plugin/assay_detector.h"
#include "properties/claims/contract.h"
#include "properties/words.h"

namespace assay::properties {

// Claims are judged by a StepDiff. It says how the detector and the oracle differ in a step, which
// pairs the candidates of a broad phase lack, and whether a limiter (a detector that says how far
// a step may go) allows too much or too little. When the host reads an answer, it sorts the pairs
// and removes duplicates (plugin_reading.cpp). So no claim can be about the order of pairs.

enum class Claim : std::uint8_t;  // below

// Outcome::refused: the input is beyond the capacity of the contract, so the detector need not
// answer.
enum class Outcome : std::uint8_t { holds, defect, undecided, error, refused };
constexpr auto names_of(Outcome) {
  using enum Outcome;
  return std::to_array<Named<Outcome>>({{holds, "holds"},
                                        {defect, "defect"},
                                        {undecided, "undecided"},
                                        {error, "error"},
                                        {refused, "refused: capacity"}});
}

// A pair whose first time the detector states wrongly.
struct WrongTime {
  TrianglePair pair;
  TimeEnclosure detector, oracle;
};

// The error of a stated first time, as a share of the step. The lower end of the stated interval is
// compared with the exact time t*, because the caller advances to that end. The time is late if the
// end is after t* by more than the tolerance, and early if the end is before t* by more than the
// tolerance. If t* is 0.75, [0.25, 1] is early by 0.5, although the interval contains t*. `late` or
// `early` is 0. All counts of late and early first times use this struct (step_measures.h).
struct TimeOff {
  double late = 0, early = 0;
  // The difference between the two lower ends, in steps from one double to the next; 0 if the time
  // is neither late nor early.
  double ulps = 0;
};

// The first times of the detector and of the oracle, and the detector's error.
struct FirstTimes {
  TimeEnclosure detector, oracle;
  TimeOff off;
};

// given_pairs: the number of candidate pairs that the detector gave. least: the least possible
// number, which is the number of pairs in contact that count.
struct CandidateCount {
  std::uint64_t given_pairs = 0, least = 0;
};

// The part of the motion that a limiter allowed in a step that starts without a contact
// (judge_limit).
struct LimitDiff {
  double share = -1;  // the share of the step that the limiter states; -1: not stated
  // `share`; if it is not stated, the length of the way to the allowed positions, divided by the
  // length of the way of the whole step.
  double way = 0;
  std::optional<TimeEnclosure> ahead;  // the first contact time of the step, if any
  // The first contact on the straight way to the place where the caller stops.
  std::optional<PairContact> hit;
  bool is_cut = false;      // the step has no contact, and the limiter stops it early
  bool too_far = false;     // the stated share is not below the first contact time
  bool too_short = false;   // `way` is shorter than claimed, and rounding is not the reason
  bool is_excused = false;  // `way` is shorter than claimed, and rounding may be the reason
  // The cause of the contact ahead, if the limiter allows no motion although the caller could move.
  std::string stall;
};

struct StepDiff {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> breaches;        // claims of the detector that this step refutes
  Answer answer = Answer::undecided;  // the answer of the detector
  bool oracle_complete = false;       // false: the oracle was stopped
  bool nothing_in_contact = false;    // no contact, not even a left-out one; the oracle is complete
  bool starts_near = false;           // StepTruth::starts_near
  bool claims_pairs = false;          // a claim about pairs is made (About::pairs)
  bool unanswered_contact = false;    // a contact counts, and there is no answer to judge
  bool owes_answer = false;           // the step is valid, within the capacity and not answered
  // The detector or the oracle was stopped: only the part that both reached is compared.
  bool partial = false;
  bool answered_free = false;       // `free`, although there is a contact that counts
  bool answered_collision = false;  // `collision`, and there is no contact at all
  // Detector and oracle answer collision, and the detector's interval misses t* by more than the
  // tolerance: the interval begins after t* (late), or ends before t* (early).
  bool late_first = false, early_first = false;
  // Pairs of the oracle that the detector does not report. Empty if the detector reports none and
  // claims no pairs.
  std::vector<PairContact> missing;
  bool is_without_excuse = false;     // the claim first-pairs asks for one of `missing`
  std::vector<PairContact> excuses;   // missing pairs that no claim asks for
  std::vector<PairContact> spurious;  // reported, but not in contact
  // Pairs whose stated interval begins after the oracle's time of the pair (late, which is unsafe),
  // or ends before that time (early).
  std::vector<WrongTime> late, early;

  // Under a contract with a margin: the first pair that comes within separation + margin, if the
  // interval of the detector's first time ends before the time of that pair.
  std::optional<PairContact> first_in_slack;

  // The earliest contact that counts, if any.
  std::optional<PairContact> first_contact;
  // The detector's first time, and the exact first time of the contacts that count, if detector and
  // oracle answer collision.
  std::optional<FirstTimes> first;

  // Returns whether the answer is wrong, whatever the detector claims.
  bool wrong_answer() const { return answered_free || answered_collision; }
  bool wrong_first_time() const { return late_first || early_first; }

  // Pairs in contact that the contract lets the detector leave out. `left_out_missed`: if these
  // pairs counted, the answer `free`, or the first time, would be wrong.
  std::vector<PairContact> left_out;
  bool left_out_missed = false;

  // Only for a detector that claims candidates; nothing if the detector failed to give candidates.
  std::optional<CandidateCount> candidates;
  std::vector<PairContact> missing_candidates;
  std::optional<LimitDiff> limit;    // only for a limiter
  bool has_answer = true;            // false: the library gives candidates or limits, no answers
  std::optional<StepLoad> overload;  // only if the step was refused as beyond the capacity
};

// A pair that comes within separation + margin (StepDiff::first_in_slack).
struct WithinSlack {
  PairContact contact;
};
// The way in which a step breaks a claim. `kind` is the kind of the failure ("late pair"; null: the
// claim is not broken). `by` is the evidence: a contact of the oracle, a pair that only comes
// within the margin, a pair with a wrong time, a pair that is not in contact, or no evidence.
struct Symptom {
  const char* kind = nullptr;
  std::variant<std::monostate, PairContact, WithinSlack, WrongTime, TrianglePair> by = {};
};
// Returns `a` if it breaks the claim, else `b`.
inline Symptom operator|(const Symptom& a, const Symptom& b) { return a.kind ? a : b; }

inline Symptom if_so(bool is_so, const char* kind, const std::optional<PairContact>& contact = {}) {
  if (!is_so) return {};
  return contact ? Symptom{kind, *contact} : Symptom{kind};
}
template <class Wrong>
Symptom if_any(const char* kind, const std::vector<Wrong>& list) {
  return list.empty() ? Symptom() : Symptom{kind, list.front()};
}

// The claims that a detector can make.

// In the list below t* is the first contact time of the step. Under a contract with a separation d,
// a contact is a pair that comes within d. The contact graph at t* has the triangles as nodes, and
// the pairs in contact at t* as edges.
enum class Claim : std::uint8_t {
  free_sound,     // never `free` when the oracle has a contact
  not_late,       // lower end of its first time <= t*
  first_time,     // the interval of its first time holds t*
  first_pairs,    // every connected part of the contact graph at t* holds a reported pair
  all_pairs,      // every pair of the oracle is reported, and no time is after the oracle's time
  no_spurious,    // every reported contact exists, and none is reported too early
  deterministic,  // the same input gives the same result
  total,          // every valid input within the limits is answered
  candidates,     // every pair of the oracle is among the candidate pairs of its broad phase
  // Claims of a limiter (L17), in steps that start without a contact.
  commit_free,  // the step to the allowed positions has no contact
  path_free,    // the allowed share is below t*
  progress,     // the allowed share is at least Contract::progress * t* (judge_limit)
  whole,        // a step without a contact is allowed to its very end
  // Every time has the same bits as the oracle's time. If a detector claims this, its other claims
  // about times are judged as strictly. Only the built-in detector claims times_unique. Plug-ins
  // cannot claim it, and no list names it.
  times_unique,
};

// The subject of a claim. The subject decides which part of a library can make the claim; any part
// can make a claim about `runs`. `times` is for claims that fail by a time too late or too early:
// the explanation says by how much (verdict.cpp). If a detector makes a claim about `pairs`, a
// missing pair makes a step unsafe (StepDiff::claims_pairs).
enum class About : std::uint8_t { answers, times, pairs, broad_phase, limits, runs };

// The kind of step or run that puts a claim to the test.
enum class Probe : std::uint8_t {
  by_step,           // any judged step
  by_contact,        // a step with a contact that counts
  by_stated_time,    // the same, with a first time stated to widest_stated_time or better
  by_candidates,     // a step with pairs that must be among the candidates
  by_contact_ahead,  // a step of a limiter that starts without a contact and has one later
  by_free_way,       // a step of a limiter without any contact
  by_second_run,     // a second run of the same case
};

// What a detector does wrong when it breaks a claim. One mistake in a detector can cause all of its
// failures of one deed. A failure whose kind begins with "early" has the deed `reports`, whatever
// its claim.
enum class Deed : std::uint8_t { loses, reports, stops, differs, ends };
constexpr auto names_of(Deed) {
  using enum Deed;
  return std::to_array<Named<Deed>>({{loses, "lose a contact"},
                                     {reports, "report a false or too early contact"},
                                     {stops, "stop the caller too early"},
                                     {differs, "give another answer in a second run"},
                                     {ends, "end without an answer"}});
}

// All facts about a claim, for the code that judges it, leaves it out or names it.
struct ClaimRow {
  Claim value;
  const char* name;     // its word; with _ in place of -, its name in reports/steps/exported_case.h
  std::uint32_t bit;    // its bit in assay_description::claims; 0: no plug-in can claim it
  std::uint32_t since;  // the first version of the plug-in interface that has the bit
  About about;
  Probe probe;
  Deed deed;
  // Returns how a step breaks the claim. The default is for two claims that no step breaks:
  // `deterministic`, for which two runs are compared (exam.h), and times_unique, which only makes
  // other claims stricter.
  Symptom (*symptom_of)(const StepDiff&) = [](const StepDiff&) { return Symptom(); };
  // Returns why the claim is not judged under this contract; empty if the claim is judged.
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
       [](D d) {  // if the oracle was stopped, the exact first time is unknown
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
                                            : "the detector has a margin, and tests neighbours";
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
  // Return the claims that both sets have, the claims that only this set has, and the claims that
  // at least one set has.
  constexpr Claims only(const Claims& others) const { return of_bits(bits_ & others.bits_); }
  constexpr Claims without(const Claims& others) const { return of_bits(bits_ & ~others.bits_); }
  constexpr Claims with(const Claims& others) const { return of_bits(bits_ | others.bits_); }

  friend constexpr bool operator==(const Claims&, const Claims&) = default;

 private:
  static constexpr std::uint32_t bit_of(Claim claim) { return 1u << static_cast<unsigned>(claim); }
  std::uint32_t bits_ = 0;
};

// Returns the claims about these subjects that a plug-in can make.
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

// Returns the claims of the built-in detector. With Arithmetic::exact it makes all claims about
// answers, times, pairs and runs. With Arithmetic::bounded it makes the same claims except
// no-spurious and times-unique (an interval contains the exact time by construction, see
// StepResult::first). With other arithmetic it claims only deterministic and total. With
// Pairs::first it never claims all-pairs.
inline Claims claims_of(const Options& options) {
  const bool exact = options.arithmetic == Arithmetic::exact;
  const bool is_proved = exact || options.arithmetic == Arithmetic::bounded;
  Claims claims = {Claim::deterministic, Claim::total};
  if (!is_proved) return claims;
  claims = claims.with({Claim::free_sound, Claim::not_late, Claim::first_time, Claim::first_pairs});
  claims.set(Claim::all_pairs, options.pairs == detector::Pairs::all);
  return claims.set(Claim::no_spurious, exact).set(Claim::times_unique, exact);
}

// Returns the claims that are also in claims_from_outside, in the order of Claim.
std::vector<Claim> list_of(const Claims& claims);
// Return the words of claims, and the claims of words. A word that names no claim is ignored.
std::vector<std::string> words_of(const Claims& claims);
Claims claims_named(const std::vector<std::string>& words);

// The progress that the built-in detector promises when it limits a step.
inline constexpr double built_in_progress = 0.9;

// Returns the contract of the built-in detector with these options. If the options have a
// separation, the contract asks for pairs without a shared vertex that come within the separation;
// otherwise it asks for contacts.
Contract contract_of(const Options& options);

// Returns the claims that are judged under this contract (ClaimRow::why_void). If the contract has
// a margin, the detector may report pairs that come within separation + margin. False alarms are
// then judged by that distance: always in queries, but in steps only if the detector leaves
// neighbours out.
Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries = false);

// Adds to diff.breaches each of the claims that the step breaks. If the step breaks a claim, the
// outcome becomes Outcome::defect.
void weigh(const Claims& claims, StepDiff& diff);

// The description that a plug-in gives of itself.

// The parts of a library. The defaults are those of the built-in detector, which answers steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool limit = false;
  bool takes_threads = false;  // the library has a function that limits its number of threads
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// Returns why a text cannot be the name or version of a detector: it is longer than 100 bytes,
// begins or ends with a space, or is the name of the built-in detector. Empty for a valid text.
std::string fault_of_name(std::string_view name);

// Returns the contradiction in a description: claims on limits without a function `limit`, a
// function `limit` without claims on limits, or only one of the claim `progress` and the number
// Contract::progress. Empty if there is no contradiction.
std::string fault_of_limits(const Claims& claims, const Contract& contract, bool has_limit);

// Returns the claims of a plug-in that can be judged by playing steps. For a library that answers
// no steps, these are the claims about candidates, limits and runs; otherwise they are all claims.
Claims claims_on_steps(const PluginDescription& description);
// Returns the claims of a plug-in that can be judged by asking its query: all except those about
// pairs, candidates and limits.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
