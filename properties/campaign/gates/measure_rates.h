// Rates and quantiles of what is counted of a plug-in whatever it claims.
#pragma once

#include "properties/campaign/gates/statistics.h"
#include "properties/campaign/stored/step_measures.h"

namespace assay::properties {

struct Rate {
  std::uint64_t of = 0, in = 0;
  ShareInterval interval;  // with confidence 95 %
  double share() const { return in ? static_cast<double>(of) / static_cast<double>(in) : 0; }
};

// Free steps that were answered collision. Steps of one trial depend on each other: the interval
// counts (sum of n)^2 / (sum of n^2) of them, n a trial's free steps, which are as many as the
// trials where all have as many steps (Kish, Survey Sampling, 1965, 11.7).
Rate false_alarm_rate(const StepMeasures& measures);
// Steps with a contact that counts that were answered free; its interval is made in the same way.
Rate miss_rate(const StepMeasures& measures);
// 0 without steps.
double spurious_pairs_a_step(const StepMeasures& measures);

// Candidates by the least possible; 0 where no pair was in contact.
double candidates_over_least(const StepMeasures& measures);

// By which share of the step the first time is off, over all steps in which the detector and the
// oracle have one: 0 in those that are not.
struct TimesOff {
  std::uint64_t steps = 0;  // that are off
  double median = 0, p99 = 0, worst = 0;
};
TimesOff times_late(const StepMeasures& measures);
TimesOff times_early(const StepMeasures& measures);

}  // namespace assay::properties
