#include "properties/campaign/record.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>

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
  ++sizes[log2_of(record.triangles)];
  ++contacts[log2_of(record.pairs)];
}

void Tally::add(const TrialRecord& record) {
  strata[record.family].add(record);
  properties::add(counts, record.counts);
  disturbances += record.disturbed;
  const bool has_ended = record.outcomes.find(letter_of(Outcome::undecided)) == std::string::npos;
  if (record.slowest_us < near_from_us || !has_ended) return;
  near.push_back(record);
  near.back().counts.clear();
}

std::uint64_t Tally::trials() const {
  std::uint64_t sum = 0;
  for (const auto& [family, stratum] : strata) sum += stratum.trials;
  return sum;
}

std::uint64_t Tally::disturbed() const {
  std::uint64_t sum = 0;
  for (const auto& [family, stratum] : strata) sum += stratum.disturbed;
  return sum;
}

}  // namespace assay::properties
