// What is counted of a plug-in's steps, whatever it claims: how wrong its answers are, how many
// candidates it gives, what its contract leaves out. A trial keeps these sums, and tallies add them
// up.
#pragma once

#include <cstdint>
#include <span>

#include "properties/judging/step_errors.h"

namespace assay::properties {

// Bounds on the share of failures that trials support.

// The confidence with which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// The exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest share
// p at which at most `failures` of `trials` still has a chance of `risk` or more. 1 without
// trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

// The interval in which a share lies with confidence 95 %. `of` out of `in` trials count for the
// share, but only `independent` of the `in` are worth counting, because the others depend on
// these. It is the interval of Clopper and Pearson with both ends; the numbers may be fractions.
// [0, 1] if there are none.
struct ShareInterval {
  double lo = 0, hi = 1;
};
ShareInterval share_interval(double of, double in, double independent);

// The risk of each of `bounds` bounds so that all hold together with confidence 95 % (Bonferroni).
double risk_of_each(std::uint64_t bounds);

// An interval of the first time that is wider than this says too little for the claim first-time.
inline constexpr double widest_stated_time = widest_time_tolerance;

struct StepMeasures {
  StepErrors errors;
  // The sums over the trials of the squares of their numbers of free steps, and of steps with a
  // contact. They tell how much the steps of one trial hang together.
  std::uint64_t free_squared = 0, contact_squared = 0;
  std::uint64_t without_time = 0;      // of the collisions: in a wider interval
  std::uint64_t unanswered = 0;        // steps with a contact that have no answer to be judged
  std::uint64_t candidate_steps = 0;   // steps for which candidates were given
  std::uint64_t candidates = 0;        // given in these steps
  std::uint64_t least_candidates = 0;  // pairs in contact that count, in these steps
  // Steps that are within the separation at t = 0. They are judged, and counted nowhere else here.
  std::uint64_t starts_near = 0;
  // What the contract leaves out.
  std::uint64_t redrawn = 0;          // cases that it does not take at all
  std::uint64_t steps_left_out = 0;   // steps left out of cases that it takes
  std::uint64_t refused = 0;          // steps that were refused as beyond the capacity
  std::uint64_t left_out_misses = 0;  // steps that only the contract saves from being a miss
  // Of any detector: trials that were judged with a contact that the contract does not leave out,
  // trials that were run twice and compared, and trials that were judged by a relation.
  std::uint64_t contact_trials = 0, repeated_trials = 0, relation_trials = 0;

  StepMeasures& operator+=(const StepMeasures& other);
  friend bool operator==(const StepMeasures&, const StepMeasures&) = default;
};
ASSAY_FIELDS(StepMeasures, errors, free_squared, contact_squared, without_time, unanswered,
             candidate_steps, candidates, least_candidates, starts_near, redrawn, steps_left_out,
             refused, left_out_misses, contact_trials, repeated_trials, relation_trials)

// What the steps of one trial show. REQUIRES as many results as diffs, in the same order.
StepMeasures measures_of(std::span<const StepDiff> diffs,
                         std::span<const detector::StepResult> results);

// Whether a contact that the contract does not leave out was judged in one of the steps.
bool has_judged_contact(std::span<const StepDiff> diffs);

struct Rate {
  std::uint64_t of = 0, in = 0;
  ShareInterval interval;  // with confidence 95 %
  double share() const { return in ? static_cast<double>(of) / static_cast<double>(in) : 0; }
};

// The share of the free steps that were answered collision. Steps of one trial depend on each
// other. So the interval counts only (sum of n)^2 / (sum of n^2) of them, where n is the number of
// free steps of a trial; if all trials have equally many, this is the number of trials (Kish,
// Survey Sampling, 1965, 11.7).
Rate false_alarm_rate(const StepMeasures& measures);
// The share of the steps with a contact that counts that were answered free. Its interval is made
// in the same way.
Rate miss_rate(const StepMeasures& measures);
// 0 without steps.
double spurious_pairs_a_step(const StepMeasures& measures);
// Candidates over the least possible number; 0 if no pair was in contact.
double candidates_over_least(const StepMeasures& measures);

}  // namespace assay::properties
