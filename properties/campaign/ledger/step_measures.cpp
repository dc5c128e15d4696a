#include "properties/campaign/ledger/step_measures.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/beta.hpp>

namespace assay::properties {

double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk) {
  if (trials == 0 || failures >= trials) return 1;
  return boost::math::binomial_distribution<double>::find_upper_bound_on_p(
      static_cast<double>(trials), static_cast<double>(failures), risk);
}

ShareInterval share_interval(double of, double in, double independent) {
  ShareInterval interval;
  if (!(in > 0) || !(independent > 0)) return interval;
  const double n = std::min(independent, in), k = of / in * n;
  constexpr double each_side = 0.025;
  // The tails of a binomial distribution are beta distributions, so the ends of the interval are
  // quantiles of these.
  if (k > 0) interval.lo = boost::math::ibeta_inv(k, n - k + 1, each_side);
  if (k < n) interval.hi = boost::math::ibeta_inv(k + 1, n - k, 1 - each_side);
  return interval;
}

double risk_of_each(std::uint64_t bounds) {
  constexpr double family_risk = 0.05;
  static_assert(family_risk + family_confidence == 1);
  return family_risk / static_cast<double>(std::max<std::uint64_t>(bounds, 1));
}

namespace {

// `squared` is the sum over trials of the squares of their numbers of steps.
Rate rate_of(std::uint64_t of, std::uint64_t in, std::uint64_t squared) {
  const auto all = static_cast<double>(in);
  const double independent = squared ? all * all / static_cast<double>(squared) : 0;
  return {of, in, share_interval(static_cast<double>(of), all, independent)};
}

double ratio_of(std::uint64_t of, std::uint64_t in) {
  return in ? static_cast<double>(of) / static_cast<double>(in) : 0;
}

}  // namespace

StepMeasures& StepMeasures::operator+=(const StepMeasures& other) {
  return add_fields(*this, other);
}

StepMeasures measures_of(std::span<const StepDiff> diffs,
                         std::span<const detector::StepResult> results) {
  StepMeasures sum;
  for (std::size_t s = 0; s < diffs.size(); ++s) {
    const StepDiff& diff = diffs[s];
    if (diff.outcome == Outcome::refused) {
      ++sum.refused;
      continue;
    }
    if (diff.starts_near) {
      ++sum.starts_near;
      continue;
    }
    sum.errors += errors_of(diff);
    sum.unanswered += diff.unanswered_contact ? 1 : 0;
    if (!diff.oracle_complete) continue;
    if (diff.candidates) {
      ++sum.candidate_steps;
      sum.candidates += diff.candidates->given;
      sum.least_candidates += diff.candidates->least;
    }
    const auto& first = results[s].first;
    if (diff.first && first.hi - first.lo > widest_stated_time) ++sum.without_time;
  }
  sum.free_squared = sum.errors.free * sum.errors.free;
  sum.contact_squared = sum.errors.contact * sum.errors.contact;
  return sum;
}

bool has_judged_contact(std::span<const StepDiff> diffs) {
  return std::any_of(diffs.begin(), diffs.end(), [](const StepDiff& diff) {
    if (diff.starts_near) return false;
    return diff.has_answer ? diff.first_contact.has_value() && !diff.partial
           : diff.limit    ? diff.limit->ahead && !diff.partial
                           : diff.candidates && diff.candidates->least > 0;
  });
}

Rate false_alarm_rate(const StepMeasures& m) {
  return rate_of(m.errors.false_alarms, m.errors.free, m.free_squared);
}

Rate miss_rate(const StepMeasures& m) {
  return rate_of(m.errors.missed, m.errors.contact, m.contact_squared);
}

double spurious_pairs_a_step(const StepMeasures& m) {
  return ratio_of(m.errors.spurious, m.errors.answered());
}

double candidates_over_least(const StepMeasures& m) {
  return ratio_of(m.candidates, m.least_candidates);
}

}  // namespace assay::properties
