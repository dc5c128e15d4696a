// What is counted of a plug-in's steps whatever it claims: false alarms, misses, spurious pairs,
// candidates, and how late and how early its times are. A trial keeps them among its counts.
#pragma once

#include <map>
#include <span>

#include "properties/campaign/stored/record.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// An interval of the first time that is wider states no time.
inline constexpr double widest_stated_time = widest_time_tolerance;

// Shares of a step by how often they were met, rounded up to two digits ("0.00012").
using ByHowMuch = std::map<double, std::uint64_t>;

// Sums over steps that oracle and detector both answered.
struct StepMeasures {
  std::uint64_t steps = 0;
  std::uint64_t free_steps = 0;    // nothing is in contact
  std::uint64_t false_alarms = 0;  // of these, answered collision
  // The sum over trials of the square of their free steps: how much they hang together.
  std::uint64_t free_steps_squared = 0;
  std::uint64_t contact_steps = 0;          // something that counts is in contact
  std::uint64_t contact_steps_squared = 0;  // over trials, as free_steps_squared
  std::uint64_t answered_free = 0;          // of these
  std::uint64_t collisions = 0;             // of these, answered collision
  std::uint64_t without_time = 0;      // of these collisions, with an interval that states no time
  std::uint64_t spurious_pairs = 0;    // in all steps
  std::uint64_t candidate_steps = 0;   // that candidates were given for
  std::uint64_t candidates = 0;        // in these
  std::uint64_t least_candidates = 0;  // pairs in contact that count, in these
  ByHowMuch late, early;               // of `collisions`, those that are; whatever is tolerated
  // By the contract.
  std::uint64_t redrawn = 0;          // cases that it does not take at all
  std::uint64_t steps_left_out = 0;   // of those that it takes
  std::uint64_t left_out_misses = 0;  // steps that it alone saves from being a miss

  std::uint64_t late_steps() const;
  std::uint64_t early_steps() const;
};

// The entry at a share of `all`, of which those that are not in `values` are 0: 0.5 is the median.
double quantile_of(const ByHowMuch& values, std::uint64_t all, double share);
double worst_of(const ByHowMuch& values);

// Adds what one trial's steps show to its counts. diffs and results: as many, in order.
void count_measures(std::span<const StepDiff> diffs, std::span<const detector::StepResult> results,
                    std::span<const oracle::StepJudgement> truth, Counts& counts);
void count_left_out(std::uint64_t redrawn, std::uint64_t steps, std::uint64_t misses,
                    Counts& counts);

bool is_measure(std::string_view count_name);
StepMeasures measures_in(const Counts& counts);

}  // namespace assay::properties
