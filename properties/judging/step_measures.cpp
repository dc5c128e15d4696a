#include "properties/judging/step_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace assay::properties {

namespace {

double up_to_two_digits(double share) {
  constexpr double least = 1e-300;  // below it the unit of the second digit is no double
  if (share <= least) return least;
  const double unit = std::pow(10, std::floor(std::log10(share)) - 1);
  const double rounded = std::ceil(share / unit * (1 - 1e-12)) * unit;
  double shortest = rounded;
  const auto text = fmt::format("{:.2g}", rounded);
  std::from_chars(text.data(), text.data() + text.size(), shortest);
  return shortest;
}

constexpr double least_positive = std::numeric_limits<double>::denorm_min();

TimesOff one_off(double share, double ulps) {
  if (!(share > 0)) return {};
  return {1, share, ulps, {{up_to_two_digits(share), 1}}};
}

}  // namespace

double TimesOff::quantile(double part) const {
  // This many values lie at or below the quantile.
  const auto rank = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(steps)));
  std::uint64_t below = 0;
  for (const auto& [share, count] : shares) {
    below += count;
    if (rank <= below) return share;
  }
  return 0;
}

double LimitUse::share(double part) const {
  // The worst come first. Steps that used all of the time stand in no list.
  const auto at_least_so_good =
      contact - static_cast<std::uint64_t>(part * static_cast<double>(contact - 1));
  const auto used_up = contact - unused.steps;
  if (at_least_so_good <= used_up) return 1;
  return 1 - unused.quantile(static_cast<double>(at_least_so_good - used_up) /
                             static_cast<double>(unused.steps));
}

std::uint64_t LimitUse::stalled() const {
  std::uint64_t sum = 0;
  for (const auto& [cause, count] : stalls) sum += count;
  return sum;
}

TimesOff& TimesOff::operator+=(const TimesOff& other) {
  steps += other.steps;
  worst_share = std::max(worst_share, other.worst_share);
  worst_ulps = std::max(worst_ulps, other.worst_ulps);
  add_to(shares, other.shares);
  return *this;
}

LimitUse use_of(const LimitDiff& limit) {
  LimitUse use;
  if (!limit.ahead) {
    use.free = 1;
    use.cut = limit.is_cut ? 1 : 0;
    return use;
  }
  use.contact = 1;
  use.unused = one_off(1 - limit.way / std::max(limit.ahead->lo, least_positive), 0);
  use.excused = limit.is_excused ? 1 : 0;
  if (!limit.stall.empty()) use.stalls[limit.stall] = 1;
  return use;
}

StepErrors errors_of(const StepDiff& diff) {
  StepErrors errors;
  if (!diff.oracle_complete) return errors;
  errors.steps = 1;
  if (diff.limit) errors.limits = use_of(*diff.limit);
  if (diff.answer != Answer::free && diff.answer != Answer::collision) {
    errors.undecided = 1;
    return errors;
  }
  errors.free = diff.nothing_in_contact ? 1 : 0;
  errors.contact = diff.first_contact ? 1 : 0;
  errors.missed = diff.answered_free ? 1 : 0;
  errors.false_alarms = diff.answered_collision ? 1 : 0;
  if (diff.first) {
    errors.late = one_off(diff.first->off.late, diff.first->off.ulps);
    errors.early = one_off(diff.first->off.early, diff.first->off.ulps);
  }
  errors.missing = diff.missing.size();
  errors.spurious = diff.spurious.size();
  const bool misses_pair = diff.claims_pairs && errors.missing > 0;
  errors.unsafe = errors.missed > 0 || errors.late.steps > 0 || misses_pair ? 1 : 0;
  errors.alarming = errors.false_alarms > 0 || errors.spurious > 0 ? 1 : 0;
  return errors;
}

void to_json(nlohmann::ordered_json& json, const StepErrors& errors) {
  json = json_of_fields<nlohmann::ordered_json>(errors);
}

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

// Returns the rate. `squared` is the sum over trials of the squares of their numbers of steps.
Rate rate_of(std::uint64_t of, std::uint64_t in, std::uint64_t squared) {
  const auto all = static_cast<double>(in);
  const double independent = squared ? all * all / static_cast<double>(squared) : 0;
  return {of, in, share_interval(static_cast<double>(of), all, independent)};
}

double ratio_of(std::uint64_t of, std::uint64_t in) {
  return in ? static_cast<double>(of) / static_cast<double>(in) : 0;
}

}  // namespace

StepMeasures measures_of(std::span<const StepDiff> diffs, std::span<const StepResult> results) {
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
      sum.candidates += diff.candidates->given_pairs;
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
  return std::ranges::any_of(diffs, [](const StepDiff& diff) {
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
  return ratio_of(m.errors.spurious, m.errors.answers());
}

double candidates_over_least(const StepMeasures& m) {
  return ratio_of(m.candidates, m.least_candidates);
}

}  // namespace assay::properties
