// What is counted of a plug-in's steps, whatever it claims: false alarms, misses, spurious pairs,
// candidates, and how late and how early its times are. A trial keeps these sums among its counts.
#pragma once

#include <map>
#include <span>

#include "properties/campaign/stored/record.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// An interval of the first time that is wider than this says too little for the claim first-time.
inline constexpr double widest_stated_time = widest_time_tolerance;

// How often each share of a step was met. Shares are rounded up to two digits ("0.00012").
using ByHowMuch = std::map<double, std::uint64_t>;

// Sums over the steps that both the oracle and the detector answered.
struct StepMeasures {
  std::uint64_t steps = 0;
  std::uint64_t free_steps = 0;    // steps in which nothing is in contact
  std::uint64_t false_alarms = 0;  // of the free steps: answered collision
  // The sum over the trials of the square of their number of free steps. It tells how much the
  // steps of one trial hang together.
  std::uint64_t free_steps_squared = 0;
  std::uint64_t contact_steps = 0;          // something that counts is in contact
  std::uint64_t contact_steps_squared = 0;  // as free_steps_squared
  std::uint64_t answered_free = 0;          // of the contact steps: answered free
  std::uint64_t collisions = 0;             // of the contact steps: answered collision
  std::uint64_t without_time = 0;           // of these collisions: in a wider interval
  std::uint64_t spurious_pairs = 0;         // in all steps
  std::uint64_t candidate_steps = 0;        // steps for which candidates were given
  std::uint64_t candidates = 0;             // given in these steps
  std::uint64_t least_candidates = 0;       // pairs in contact that count, in these steps
  ByHowMuch late, early;                    // of `collisions` (TimeOff, agreement.h)
  // What the contract leaves out.
  std::uint64_t redrawn = 0;          // cases that it does not take at all
  std::uint64_t steps_left_out = 0;   // steps left out of cases that it takes
  std::uint64_t left_out_misses = 0;  // steps that only the contract saves from being a miss
  // Of any detector: trials that were judged with a contact that the contract does not leave out,
  // and trials that were run twice and compared.
  std::uint64_t contact_trials = 0, repeated_trials = 0;

  std::uint64_t late_steps() const;
  std::uint64_t early_steps() const;
};

// The value at this share of the values in ascending order: 0.5 is the median. 0 if there is none.
double quantile_of(const ByHowMuch& values, double share);
double worst_of(const ByHowMuch& values);

// Whether a contact that the contract does not leave out was judged in one of the steps.
bool has_judged_contact(std::span<const StepDiff> diffs);

// Adds what the steps of one trial show to its counts. REQUIRES as many results and judgements as
// diffs, in the same order.
void count_measures(std::span<const StepDiff> diffs, std::span<const detector::StepResult> results,
                    std::span<const oracle::StepJudgement> truth, Counts& counts);
void count_trial(bool has_contact, bool is_repeated, Counts& counts);
void count_left_out(std::uint64_t redrawn, std::uint64_t steps, std::uint64_t misses,
                    Counts& counts);

bool is_measure(std::string_view count_name);
StepMeasures measures_in(const Counts& counts);

}  // namespace assay::properties
