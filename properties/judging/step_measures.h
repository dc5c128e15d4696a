// Measures how wrong the answers of a detector were, in one step or summed over many. Campaigns,
// `check` and all benches use these counts, so that each word has one meaning. Other counts of a
// plug-in's steps are here too.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "properties/fields.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// First times that are off on one side of the exact one (TimeOff, claims.h).
struct TimesOff {
  std::uint64_t steps = 0;
  double worst_share = 0;  // the greatest share of a step by which a time is off
  double worst_ulps = 0;
  // How often each share of a step was met, for quantiles. A share is rounded upward to two digits
  // (0.00012), so that no time looks better than it is, and sums stay short.
  std::map<double, std::uint64_t> shares;

  // Returns the quantile of the rounded shares: `part` 0.5 gives the median, and 1 the worst share.
  // Returns 0 if there are no shares.
  double quantile(double part) const;

  TimesOff& operator+=(const TimesOff& other);
  friend bool operator==(const TimesOff&, const TimesOff&) = default;
};

// How far a limiter lets steps go, over the steps that start without a contact.
struct LimitUse {
  std::uint64_t free = 0;     // steps without any contact
  std::uint64_t cut = 0;      // of `free`: stopped before their end
  std::uint64_t contact = 0;  // steps with a contact ahead
  TimesOff unused;            // of `contact`: the unused share of the time until the contact
  // Of `contact`: less was used than is claimed, perhaps because of rounding (judge_limit).
  std::uint64_t excused = 0;
  std::map<std::string, std::uint64_t> stalls;  // of `contact`, by their cause (LimitDiff::stall)

  // Returns the quantile of the used shares of the time until the contact: `part` 0 gives the worst
  // (least) share, 0.5 the median. REQUIRES contact > 0.
  double share(double part) const;
  std::uint64_t stalled() const;

  static constexpr bool adds_up = true;
  friend bool operator==(const LimitUse&, const LimitUse&) = default;
};

// Steps that the oracle did not finish are not counted at all. A step without an answer is counted
// only in `steps` and `undecided`, so that all other numbers are of answered steps. Contacts are
// those that count under the contract.
struct StepErrors {
  std::uint64_t steps = 0;
  std::uint64_t undecided = 0;     // neither `free` nor `collision`: undecided, an error, no run
  std::uint64_t free = 0;          // no pair is in contact, not even a left-out one
  std::uint64_t contact = 0;       // a pair that counts is in contact
  std::uint64_t missed = 0;        // of `contact`: answered `free`
  std::uint64_t false_alarms = 0;  // of `free`: answered `collision`
  // Of the steps with a contact that were answered `collision`: the first time is after (late) or
  // before (early) the exact one, by more than the contract tolerates.
  TimesOff late, early;
  // Steps that would hurt a user who trusts the answer: missed, late, or without a pair that the
  // detector's claims promise.
  std::uint64_t unsafe = 0;
  // Steps in which a user would look for a contact in vain: a false alarm, or a spurious pair.
  std::uint64_t alarming = 0;
  // Numbers of pairs. Missing: in contact, asked for by the claims, and not reported. Spurious:
  // reported, and not in contact.
  std::uint64_t missing = 0, spurious = 0;
  LimitUse limits;  // counted whatever is claimed, and for steps without an answer too

  std::uint64_t answers() const { return steps - undecided; }
  std::uint64_t collisions() const { return contact - missed; }  // of `contact`

  static constexpr bool adds_up = true;
  friend bool operator==(const StepErrors&, const StepErrors&) = default;
};

// Returns the errors of one step.
StepErrors errors_of(const StepDiff& diff);

// Writes {"steps": 3, ..., "late": {"steps": 1, "worst_share": 0.00012, ...}, ...}: every member by
// its name. Detectors that are no limiters have no object `limits`.
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

// Counts a plug-in's steps, whatever it claims: how wrong its answers are, how many candidates it
// gives, what its contract leaves out. A trial stores these sums, and tallies add them up.

// Computes the bounds on the share of failures that trials support.

// The confidence with which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// Returns the exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest
// share p at which `failures` or fewer in `trials` still have a chance of `risk` or more. Returns 1
// without trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

// The interval in which a share of `of` out of `in` trials lies with confidence 95 %. Only
// `independent` of the `in` trials count as evidence, because the others depend on these. It is the
// two-sided interval of Clopper and Pearson; the numbers may be fractions. [0, 1] if there are no
// trials.
struct ShareInterval {
  double lo = 0, hi = 1;
};
ShareInterval share_interval(double of, double in, double independent);

// Returns the risk of each bound if `bounds` of them hold together with confidence 95 %
// (Bonferroni).
double risk_of_each(std::uint64_t bounds);

// An interval of the first time that is wider than this is too wide for the claim first-time.
inline constexpr double widest_stated_time = widest_time_tolerance;

struct StepMeasures {
  StepErrors errors;
  // For each trial, the square of its number of free steps, and of steps with a contact; summed
  // over trials. They show how much the steps of one trial depend on each other.
  std::uint64_t free_squared = 0, contact_squared = 0;
  std::uint64_t without_time = 0;      // collisions answered with a wider interval
  std::uint64_t unanswered = 0;        // steps with a contact and without an answer to judge
  std::uint64_t candidate_steps = 0;   // steps for which candidates were given
  std::uint64_t candidates = 0;        // given in these steps
  std::uint64_t least_candidates = 0;  // pairs in contact that count, in these steps
  // Steps within the separation at t = 0. They are judged, and counted nowhere else here.
  std::uint64_t starts_near = 0;
  // Left out by the contract.
  std::uint64_t redrawn = 0;          // cases that the contract rejects wholly
  std::uint64_t steps_left_out = 0;   // steps left out of the other cases
  std::uint64_t refused = 0;          // steps that were refused as beyond the capacity
  std::uint64_t left_out_misses = 0;  // steps that only the contract saves from being a miss
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

// Returns the share of the free steps that were answered collision. Steps of one trial depend on
// each other. So the interval counts only (sum of n)^2 / (sum of n^2) steps, where n is the number
// of free steps of a trial (Kish, Survey Sampling, 1965, 11.7). If n is the same for all trials,
// this is the number of trials.
Rate false_alarm_rate(const StepMeasures& measures);
// Returns the share of steps answered free among the steps with a contact that counts. Its interval
// is made in the same way.
Rate miss_rate(const StepMeasures& measures);
// Returns 0 without steps.
double spurious_pairs_a_step(const StepMeasures& measures);
// Returns the number of candidates over the least possible number; 0 if no pair was in contact.
double candidates_over_least(const StepMeasures& measures);

}  // namespace assay::properties
