#include "properties/judging/step_errors.h"

#include <fmt/format.h>

#include <algorithm>
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

double LimitUse::used(double part) const {
  // The worst come first. What was used to the end stands in no list.
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

StepErrors& StepErrors::operator+=(const StepErrors& other) { return add_fields(*this, other); }

LimitUse& LimitUse::operator+=(const LimitUse& other) { return add_fields(*this, other); }

LimitUse use_of(const LimitDiff& limit) {
  LimitUse use;
  if (!limit.ahead) {
    use.free = 1;
    use.cut = limit.is_cut ? 1 : 0;
    return use;
  }
  use.contact = 1;
  use.unused = one_off(1 - limit.used / std::max(limit.ahead->lo, least_positive), 0);
  use.excused = limit.is_excused ? 1 : 0;
  if (!limit.stall.empty()) use.stalls[limit.stall] = 1;
  return use;
}

StepErrors errors_of(const StepDiff& diff) {
  using detector::Answer;
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

}  // namespace assay::properties
