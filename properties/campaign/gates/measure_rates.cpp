#include "properties/campaign/gates/measure_rates.h"

namespace assay::properties {
namespace {

// `squared` is the sum over trials of the squares of their numbers of steps.
Rate rate_of(std::uint64_t of, std::uint64_t in, std::uint64_t squared) {
  const auto all = static_cast<double>(in);
  const double independent = squared ? all * all / static_cast<double>(squared) : 0;
  return {of, in, share_interval(static_cast<double>(of), all, independent)};
}

TimesOff times_off(const ByHowMuch& values, std::uint64_t steps) {
  return {steps, quantile_of(values, 0.5), quantile_of(values, 0.99), worst_of(values)};
}

}  // namespace

Rate false_alarm_rate(const StepMeasures& m) {
  return rate_of(m.false_alarms, m.free_steps, m.free_steps_squared);
}

Rate miss_rate(const StepMeasures& m) {
  return rate_of(m.answered_free, m.contact_steps, m.contact_steps_squared);
}

double spurious_pairs_a_step(const StepMeasures& m) {
  return m.steps ? static_cast<double>(m.spurious_pairs) / static_cast<double>(m.steps) : 0;
}

double candidates_over_least(const StepMeasures& m) {
  if (m.least_candidates == 0) return 0;
  return static_cast<double>(m.candidates) / static_cast<double>(m.least_candidates);
}

TimesOff times_late(const StepMeasures& m) { return times_off(m.late, m.late_steps()); }

TimesOff times_early(const StepMeasures& m) { return times_off(m.early, m.early_steps()); }

}  // namespace assay::properties
