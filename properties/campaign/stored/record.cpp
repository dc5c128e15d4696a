#include "properties/campaign/stored/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

#include "properties/campaign/stored/step_measures.h"

namespace assay::properties {

void add(Counts& sum, const Counts& more) {
  for (const auto& [name, count] : more) sum[name] += count;
}

std::string counts_text(const Counts& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ";", name, count);
  }
  return text;
}

Counts parse_counts(std::string_view text) {
  Counts counts;
  while (!text.empty()) {
    const auto word = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const auto equals = word.rfind('=');
    if (equals == std::string_view::npos) continue;
    std::uint64_t count = 0;
    std::from_chars(word.data() + equals + 1, word.data() + word.size(), count);
    counts[std::string(word.substr(0, equals))] += count;
  }
  return counts;
}

char letter_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return 'H';
    case Outcome::defect:
      return 'D';
    case Outcome::undecided:
      return 'U';
    case Outcome::error:
      return 'E';
  }
  return 'E';
}

bool TrialRecord::has(Outcome outcome) const {
  return outcomes.find(letter_of(outcome)) != std::string::npos;
}

namespace {

int log2_of(std::uint64_t n) { return n == 0 ? -1 : std::bit_width(n) - 1; }

}  // namespace

void StratumTally::add(const TrialRecord& record) {
  ++trials;
  steps += record.steps;
  collisions += record.collisions;
  pairs += record.pairs;
  oracle_us += record.oracle_us;
  detector_us += record.detector_us;
  with_defect += record.has(Outcome::defect) ? 1 : 0;
  open += record.has(Outcome::undecided) || record.has(Outcome::error) ? 1 : 0;
  disturbed += record.disturbed > 0 ? 1 : 0;
  discards += record.outcomes.empty() ? 1 : 0;
  meshes.insert(record.mesh);
  by_configuration.resize(std::max(by_configuration.size(), record.outcomes.size()));
  for (std::size_t i = 0; i < record.outcomes.size(); ++i) {
    auto& outcomes = by_configuration[i];
    switch (record.outcomes[i]) {
      case 'H':
        ++outcomes.holds;
        break;
      case 'D':
        ++outcomes.defects;
        break;
      case 'U':
        ++outcomes.undecided;
        break;
      default:
        ++outcomes.errors;
    }
  }
  for (const auto& [name, count] : record.counts) {
    if (is_measure(name)) measures[name] += count;
  }
  const auto shown = measures_in(record.counts);
  const auto grow = [&](std::uint64_t& most, bool counts) {
    if (counts) most = std::max(most, record.triangles);
  };
  grow(triangles, record.has(Outcome::holds) || record.has(Outcome::defect));
  grow(triangles_in_contact, shown.contact_trials > 0);
  grow(triangles_repeated, shown.repeated_trials > 0);
  ++sizes[log2_of(record.triangles)];
  ++contacts[log2_of(record.pairs)];
}

void Tally::add(const TrialRecord& record) {
  strata[record.family].add(record);
  properties::add(counts, record.counts);
  disturbances += record.disturbed;
  note_slow(record);
  if (record.slowest_us < near_from_us) return;
  near_limit.push_back(record);
  near_limit.back().counts.clear();
}

void Tally::note_slow(const TrialRecord& record) {
  const auto without_counts = [&] {
    TrialRecord copy = record;
    copy.counts.clear();
    return copy;
  };
  if (record.has(Outcome::undecided)) {
    if (undecided.size() < most_undecided) undecided.push_back(without_counts());
    return;
  }
  const auto is_slower = [](const TrialRecord& a, const TrialRecord& b) {
    return a.slowest_us != b.slowest_us ? a.slowest_us > b.slowest_us : a.id < b.id;
  };
  if (slowest.size() == most_slowest && !is_slower(record, slowest.back())) return;
  slowest.insert(std::upper_bound(slowest.begin(), slowest.end(), record, is_slower),
                 without_counts());
  if (slowest.size() > most_slowest) slowest.pop_back();
}

namespace {

std::uint64_t sum_of(const Tally& tally, std::uint64_t StratumTally::*count) {
  std::uint64_t sum = 0;
  for (const auto& [family, stratum] : tally.strata) sum += stratum.*count;
  return sum;
}

}  // namespace

std::uint64_t Tally::trials() const { return sum_of(*this, &StratumTally::trials); }
std::uint64_t Tally::judged() const { return trials() - sum_of(*this, &StratumTally::discards); }
std::uint64_t Tally::with_defect() const { return sum_of(*this, &StratumTally::with_defect); }
std::uint64_t Tally::open() const { return sum_of(*this, &StratumTally::open); }
std::uint64_t Tally::disturbed() const { return sum_of(*this, &StratumTally::disturbed); }

}  // namespace assay::properties
