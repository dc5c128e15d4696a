// Rates and quantiles of what is counted of a plug-in's steps, whatever it claims.
#pragma once

#include "properties/campaign/gates/statistics.h"
#include "properties/campaign/stored/step_measures.h"

namespace assay::properties {

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

// By which share of the step the first time is off, over all steps in which both the detector and
// the oracle have one. A step whose time is not off counts as 0.
struct TimesOff {
  std::uint64_t steps = 0;  // steps that are off
  double median = 0, p99 = 0, worst = 0;
};
TimesOff times_late(const StepMeasures& measures);
TimesOff times_early(const StepMeasures& measures);

}  // namespace assay::properties
