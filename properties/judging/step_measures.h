// Measures how wrong the answers of a detector were, in one step or summed over many steps.
// Campaigns, `check` and all benches use these counts, so that each word has one meaning. Also
// counts other properties of a plug-in's steps, and computes bounds on shares.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "properties/fields.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// The errors of first times that are too late, or of first times that are too early (TimeOff,
// claims.h).
struct TimesOff {
  std::uint64_t steps = 0;
  double worst_share = 0;  // the greatest error, as a share of a step
  double worst_ulps = 0;
  // The number of steps with each error, for quantiles. An error is rounded upward to two digits
  // (0.00012), so that no time looks better than it is, and the map stays small.
  std::map<double, std::uint64_t> shares;

  // Returns the quantile of the rounded errors: `part` 0.5 gives the median, and 1 the greatest
  // error. Returns 0 if there are no errors.
  double quantile(double part) const;

  TimesOff& operator+=(const TimesOff& other);
  friend bool operator==(const TimesOff&, const TimesOff&) = default;
};

// How far a limiter lets steps go, over the steps that start without a contact.
struct LimitUse {
  std::uint64_t free = 0;     // steps without any contact
  std::uint64_t cut = 0;      // how many of `free` the limiter stopped before their end
  std::uint64_t contact = 0;  // steps with a contact ahead
  TimesOff unused;            // of `contact`: the unused part of the time until the contact
  // The number of steps with a contact ahead in which the limiter allows a shorter way than it
  // claims, and rounding may be the reason (judge_limit).
  std::uint64_t excused = 0;
  // How many of `contact` the limiter does not let move at all, by the cause (LimitDiff::stall).
  std::map<std::string, std::uint64_t> stalls;

  // Returns the quantile of the used part of the time until the contact: `part` 0 gives the worst
  // (least) used part, 0.5 the median. REQUIRES contact > 0.
  double share(double part) const;
  std::uint64_t stalled() const;  // the sum of `stalls`

  static constexpr bool adds_up = true;
  friend bool operator==(const LimitUse&, const LimitUse&) = default;
};

// A step that the oracle did not finish is not counted. A step without an answer is counted only in
// `steps`, `undecided` and `limits`, so that all other numbers are about answered steps. Contacts
// are the contacts that count under the contract.
struct StepErrors {
  std::uint64_t steps = 0;
  std::uint64_t undecided = 0;     // neither `free` nor `collision`: undecided, an error, no run
  std::uint64_t free = 0;          // no pair is in contact, not even a left-out one
  std::uint64_t contact = 0;       // a pair that counts is in contact
  std::uint64_t missed = 0;        // how many of `contact` were answered `free`
  std::uint64_t false_alarms = 0;  // how many of `free` were answered `collision`
  // Steps with a contact that were answered `collision`, with a first time that is later (late) or
  // earlier (early) than the exact time by more than the contract tolerates.
  TimesOff late, early;
  // Steps that would hurt a user who trusts the answer: missed, late, or without a pair that the
  // detector's claims promise.
  std::uint64_t unsafe = 0;
  // Steps in which a user would look for a contact in vain: false alarms, and steps with a spurious
  // pair.
  std::uint64_t alarming = 0;
  // Numbers of pairs. Missing: in contact, asked for by the claims, and not reported. Spurious:
  // reported, and not in contact.
  std::uint64_t missing = 0, spurious = 0;
  LimitUse limits;  // counted whatever the detector claims, and for steps without an answer too

  std::uint64_t answers() const { return steps - undecided; }
  std::uint64_t collisions() const { return contact - missed; }  // answered `collision`

  static constexpr bool adds_up = true;
  friend bool operator==(const StepErrors&, const StepErrors&) = default;
};

// Returns the errors of one step.
StepErrors errors_of(const StepDiff& diff);

// Writes {"steps": 3, ..., "late": {"steps": 1, "worst_share": 0.00012, ...}, ...}: every member by
// its name. A detector that is no limiter has no object `limits`.
void to_json(nlohmann::ordered_json& json, const StepErrors& errors);

ASSAY_FIELDS(TimesOff, steps, worst_share, worst_ulps, shares)
ASSAY_FIELDS(LimitUse, free, cut, contact, unused, excused, stalls)

template <class Archive>
void fields(Archive& archive, StepErrors& errors) {
  auto& [steps, undecided, free, contact, missed, false_alarms, late, early, unsafe, alarming,
         missing, spurious, limits] = errors;
  archive("steps", steps, "undecided", undecided, "free", free, "contact", contact);
  archive("missed", missed, "false_alarms", false_alarms, "late", late, "early", early);
  archive("unsafe", unsafe, "alarming", alarming, "missing", missing, "spurious", spurious);
  archive.may("limits", limits);
}

// The functions below compute bounds on the share of failures, from numbers of trials.

// The confidence with which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// Returns the exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest
// share p for which at most `failures` failures in `trials` trials have a probability of at least
// `risk`. Returns 1 if there are no trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

struct ShareInterval {
  double lo = 0, hi = 1;
};
// Returns the two-sided interval of Clopper and Pearson, with confidence 95 %, for the share of
// trials with some property: `of` of the `in` trials have it. Trials depend on each other, so only
// `independent` trials count as evidence. The numbers can be fractions. Returns [0, 1] if there are
// no trials.
ShareInterval share_interval(double of, double in, double independent);

// Returns the risk of each bound if `bounds` bounds hold together with confidence 95 %
// (Bonferroni).
double risk_of_each(std::uint64_t bounds);

// A wider interval of the first time states no time: it is too wide for the claim first-time.
inline constexpr double widest_stated_time = widest_time_tolerance;

// Counts of the steps of a trial of a plug-in, whatever the plug-in claims. A trial stores its
// counts, and tallies add up the counts of trials.
struct StepMeasures {
  StepErrors errors;
  // The square of a trial's number of free steps, and of its number of steps with a contact, summed
  // over trials. The sums show how much the steps of one trial depend on each other.
  std::uint64_t free_squared = 0, contact_squared = 0;
  std::uint64_t without_time = 0;      // collisions with an interval above widest_stated_time
  std::uint64_t unanswered = 0;        // steps with a contact and without an answer to judge
  std::uint64_t candidate_steps = 0;   // steps for which the detector gave candidates
  std::uint64_t candidates = 0;        // candidates in candidate_steps
  std::uint64_t least_candidates = 0;  // pairs in contact that count, in candidate_steps
  // Steps that start within the separation. They are judged, but only this member counts them.
  std::uint64_t starts_near = 0;
  // Cases and steps that the contract leaves out.
  std::uint64_t redrawn = 0;          // cases from which the contract takes no step
  std::uint64_t steps_left_out = 0;   // steps left out of the other cases
  std::uint64_t refused = 0;          // steps that were refused as beyond the capacity
  std::uint64_t left_out_misses = 0;  // steps that would be a miss without the contract
  // For any detector: judged trials with a contact that the contract does not leave out, trials
  // that were run twice and compared, and trials judged by a relation.
  std::uint64_t contact_trials = 0, repeated_trials = 0, relation_trials = 0;

  static constexpr bool adds_up = true;
  friend bool operator==(const StepMeasures&, const StepMeasures&) = default;
};
ASSAY_FIELDS(StepMeasures, errors, free_squared, contact_squared, without_time, unanswered,
             candidate_steps, candidates, least_candidates, starts_near, redrawn, steps_left_out,
             refused, left_out_misses, contact_trials, repeated_trials, relation_trials)

// Returns the measures of one trial's steps. REQUIRES as many results as diffs, in the same order.
StepMeasures measures_of(std::span<const StepDiff> diffs, std::span<const StepResult> results);

// Returns whether a contact that the contract does not leave out was judged in one of the steps.
bool has_judged_contact(std::span<const StepDiff> diffs);

struct Rate {
  std::uint64_t of = 0, in = 0;
  ShareInterval interval;  // with confidence 95 %
  double share() const { return in ? static_cast<double>(of) / static_cast<double>(in) : 0; }
};

// Returns the share of the free steps that were answered `collision`. Steps of one trial depend on
// each other. So the interval is computed for (sum of n)^2 / (sum of n^2) independent steps, where
// n is the number of free steps of a trial (Kish, Survey Sampling, 1965, 11.7). If n is the same
// for all trials, this is the number of trials.
Rate false_alarm_rate(const StepMeasures& measures);
// Returns which share of the steps with a contact that counts was answered `free`. The interval is
// computed as for false_alarm_rate.
Rate miss_rate(const StepMeasures& measures);
// Returns the number of spurious pairs divided by the number of answered steps; 0 if no step was
// answered.
double spurious_pairs_a_step(const StepMeasures& measures);
// Returns the number of candidates over the least possible number; 0 if no pair was in contact.
double candidates_over_least(const StepMeasures& measures);

}  // namespace assay::properties
