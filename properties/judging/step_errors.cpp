#include "properties/judging/step_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "properties/json_fields.h"

namespace assay::properties {

template <class Archive>
void fields(Archive& archive, TimesOff& times) {
  auto& [steps, worst_share, worst_ulps, shares] = times;
  archive("steps", steps, "worst_share", worst_share, "worst_ulps", worst_ulps, "shares", shares);
}

template <class Archive>
void fields(Archive& archive, StepErrors& errors) {
  auto& [steps, undecided, free, contact, missed, false_alarms, late, early, unsafe, alarming,
         missing, spurious] = errors;
  archive("steps", steps, "undecided", undecided, "free", free, "contact", contact);
  archive("missed", missed, "false_alarms", false_alarms, "late", late, "early", early);
  archive("unsafe", unsafe, "alarming", alarming, "missing", missing, "spurious", spurious);
}

namespace {

double up_to_two_digits(double share) {
  const double unit = std::pow(10, std::floor(std::log10(share)) - 1);
  const double rounded = std::ceil(share / unit * (1 - 1e-12)) * unit;
  double shortest = rounded;
  const auto text = fmt::format("{:.2g}", rounded);
  std::from_chars(text.data(), text.data() + text.size(), shortest);
  return shortest;
}

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

TimesOff& TimesOff::operator+=(const TimesOff& other) {
  steps += other.steps;
  worst_share = std::max(worst_share, other.worst_share);
  worst_ulps = std::max(worst_ulps, other.worst_ulps);
  for (const auto& [share, count] : other.shares) shares[share] += count;
  return *this;
}

StepErrors& StepErrors::operator+=(const StepErrors& other) {
  for (const auto member :
       {&StepErrors::steps, &StepErrors::undecided, &StepErrors::free, &StepErrors::contact,
        &StepErrors::missed, &StepErrors::false_alarms, &StepErrors::unsafe, &StepErrors::alarming,
        &StepErrors::missing, &StepErrors::spurious}) {
    this->*member += other.*member;
  }
  late += other.late;
  early += other.early;
  return *this;
}

StepErrors errors_of(const StepDiff& diff) {
  using detector::Answer;
  StepErrors errors;
  if (!diff.oracle_complete) return errors;
  errors.steps = 1;
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

void to_json(nlohmann::json& json, const StepErrors& errors) {
  json = json_of_fields<nlohmann::json>(errors);
}
void to_json(nlohmann::ordered_json& json, const StepErrors& errors) {
  json = json_of_fields<nlohmann::ordered_json>(errors);
}
void from_json(const nlohmann::json& json, StepErrors& errors) { read_fields(json, errors); }

}  // namespace assay::properties
