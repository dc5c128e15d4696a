#include "properties/campaign/stored/step_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "properties/campaign/stored/count_names.h"

namespace assay::properties {
namespace {

using detector::Answer;

constexpr std::string_view measure_prefix = "measure:";
constexpr std::string_view late_prefix = "measure:late/", early_prefix = "measure:early/";

struct NamedMeasure {
  std::string_view name;
  std::uint64_t StepMeasures::*member;
};
constexpr NamedMeasure named_measures[] = {
    {"measure:steps", &StepMeasures::steps},
    {"measure:free-steps", &StepMeasures::free_steps},
    {"measure:false-alarms", &StepMeasures::false_alarms},
    {"measure:free-steps-squared", &StepMeasures::free_steps_squared},
    {"measure:contact-steps", &StepMeasures::contact_steps},
    {"measure:contact-steps-squared", &StepMeasures::contact_steps_squared},
    {"measure:answered-free", &StepMeasures::answered_free},
    {"measure:collisions", &StepMeasures::collisions},
    {"measure:without-time", &StepMeasures::without_time},
    {"measure:spurious-pairs", &StepMeasures::spurious_pairs},
    {"measure:candidate-steps", &StepMeasures::candidate_steps},
    {"measure:candidates", &StepMeasures::candidates},
    {"measure:least-candidates", &StepMeasures::least_candidates},
    {"measure:redrawn", &StepMeasures::redrawn},
    {"measure:steps-left-out", &StepMeasures::steps_left_out},
    {"measure:left-out-misses", &StepMeasures::left_out_misses},
    {"measure:contact-trials", &StepMeasures::contact_trials},
    {"measure:repeated-trials", &StepMeasures::repeated_trials},
};

// Rounds upward, so that no time is said to be better than it is.
double to_two_digits(double share) {
  if (share <= 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(share)) - 1);
  const double rounded = std::ceil(share / unit * (1 - 1e-12)) * unit;
  double shortest = rounded;
  const auto text = fmt::format("{:.2g}", rounded);
  std::from_chars(text.data(), text.data() + text.size(), shortest);
  return shortest;
}

std::uint64_t sum_of(const ByHowMuch& values) {
  std::uint64_t sum = 0;
  for (const auto& [value, count] : values) sum += count;
  return sum;
}

// Reads a count whose name ends in a value, a share of the step, and adds the count to that value.
void read_value(std::string_view name, std::string_view prefix, std::uint64_t count,
                ByHowMuch& values) {
  const auto word = name.substr(prefix.size());
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) values[value] += count;
}

void add_time(std::string_view prefix, double share, Counts& counts) {
  if (share > 0) ++counts[fmt::format("{}{}", prefix, to_two_digits(share))];
}

void count_step(const StepDiff& diff, const detector::StepResult& result,
                const oracle::StepJudgement& truth, Counts& counts, StepMeasures& sum) {
  if (truth.complete && diff.candidates) {
    ++sum.candidate_steps;
    sum.candidates += diff.candidates->given;
    sum.least_candidates += diff.candidates->least;
  }
  const bool is_answered = result.answer == Answer::free || result.answer == Answer::collision;
  if (!is_answered || !truth.complete) return;
  ++sum.steps;
  sum.free_steps += truth.pairs.empty() ? 1 : 0;
  sum.false_alarms += diff.answered_collision ? 1 : 0;
  sum.spurious_pairs += diff.spurious.size();
  if (!diff.first_contact) return;
  ++sum.contact_steps;
  sum.answered_free += diff.answered_free ? 1 : 0;
  if (!diff.first) return;
  ++sum.collisions;
  sum.without_time += result.first.hi - result.first.lo > widest_stated_time ? 1 : 0;
  add_time(late_prefix, diff.first->off.late, counts);
  add_time(early_prefix, diff.first->off.early, counts);
}

void add_sums(const StepMeasures& sum, Counts& counts) {
  for (const auto& [name, member] : named_measures) {
    if (sum.*member > 0) counts[std::string(name)] += sum.*member;
  }
}

}  // namespace

std::uint64_t StepMeasures::late_steps() const { return sum_of(late); }
std::uint64_t StepMeasures::early_steps() const { return sum_of(early); }

double quantile_of(const ByHowMuch& values, double share) {
  // This many values lie at or below the quantile.
  const auto rank =
      static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(sum_of(values))));
  std::uint64_t below = 0;
  for (const auto& [value, count] : values) {
    below += count;
    if (rank <= below) return value;
  }
  return 0;
}

double worst_of(const ByHowMuch& values) { return values.empty() ? 0 : values.rbegin()->first; }

void count_measures(std::span<const StepDiff> diffs, std::span<const detector::StepResult> results,
                    std::span<const oracle::StepJudgement> truth, Counts& counts) {
  StepMeasures sum;
  for (std::size_t s = 0; s < diffs.size(); ++s)
    count_step(diffs[s], results[s], truth[s], counts, sum);
  sum.free_steps_squared = sum.free_steps * sum.free_steps;
  sum.contact_steps_squared = sum.contact_steps * sum.contact_steps;
  add_sums(sum, counts);
}

bool has_judged_contact(std::span<const StepDiff> diffs) {
  return std::any_of(diffs.begin(), diffs.end(), [](const StepDiff& diff) {
    return diff.has_answer ? diff.first_contact.has_value() && !diff.partial
                           : diff.candidates && diff.candidates->least > 0;
  });
}

void count_trial(bool has_contact, bool is_repeated, Counts& counts) {
  StepMeasures sum;
  sum.contact_trials = has_contact ? 1 : 0;
  sum.repeated_trials = is_repeated ? 1 : 0;
  add_sums(sum, counts);
}

void count_left_out(std::uint64_t redrawn, std::uint64_t steps, std::uint64_t misses,
                    Counts& counts) {
  StepMeasures sum;
  sum.redrawn = redrawn;
  sum.steps_left_out = steps;
  sum.left_out_misses = misses;
  add_sums(sum, counts);
}

bool is_measure(std::string_view count_name) { return count_name.starts_with(measure_prefix); }

StepMeasures measures_in(const Counts& counts) {
  StepMeasures sum;
  for (const auto& [name, member] : named_measures) sum.*member = count_of(counts, name);
  for (const auto& [name, count] : counts) {
    if (name.starts_with(late_prefix)) read_value(name, late_prefix, count, sum.late);
    if (name.starts_with(early_prefix)) read_value(name, early_prefix, count, sum.early);
  }
  return sum;
}

}  // namespace assay::properties
