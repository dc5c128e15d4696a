#include "properties/campaign/ledger/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "properties/generators/families.h"
#include "properties/laws/metamorphic/change_laws.h"

namespace assay::properties {
namespace {

int log2_of(std::uint64_t n) { return n == 0 ? -1 : std::bit_width(n) - 1; }

// Returns whether a law is to be met under this culling by itself. Laws are met by view sets alone.
bool is_met_under(Culling culling, PremiseScope met_under) {
  switch (met_under) {
    case PremiseScope::any_culling:
      return false;
    case PremiseScope::each_culling:
      return uses_views(culling);
    case PremiseScope::each_that_chooses_views:
      return chooses_views(culling);
  }
  return false;
}

TrialRecord without_counts(TrialRecord record) {
  record.counts = {};
  return record;
}

std::uint64_t sum_of(const Tally& tally, std::uint64_t StratumTally::*count) {
  std::uint64_t sum = 0;
  for (const auto& [family, stratum] : tally.strata) sum += stratum.*count;
  return sum;
}

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
  refused += record.has(Outcome::refused) ? 1 : 0;
  meshes.insert(record.mesh);
  by_configuration.resize(std::max(by_configuration.size(), record.outcomes.size()));
  for (std::size_t i = 0; i < record.outcomes.size(); ++i) {
    auto& outcomes = by_configuration[i];
    const char letter = record.outcomes[i];
    if (letter == not_run) continue;
    ++(letter == letter_of(Outcome::holds)       ? outcomes.holds
       : letter == letter_of(Outcome::defect)    ? outcomes.defects
       : letter == letter_of(Outcome::undecided) ? outcomes.undecided
       : letter == letter_of(Outcome::refused)   ? outcomes.refused
                                                 : outcomes.errors);
  }
  const auto& addend = record.counts.measures;
  measures += addend;
  const auto grow = [&](std::uint64_t& most, bool counts) {
    if (counts && record.is_judged()) most = std::max(most, record.triangles);
  };
  grow(triangles, true);
  grow(triangles_in_contact, addend.contact_trials > 0);
  grow(triangles_repeated, addend.repeated_trials > 0);
  ++sizes[log2_of(record.triangles)];
  ++contacts[log2_of(record.pairs)];
}

void Tally::add(const TrialRecord& record) {
  strata[record.family].add(record);
  counts += record.counts;
  disturbances += record.disturbed;
  note_slow(record);
  // Large cases have another limit.
  if (record.slowest_us >= near_from_us && !is_size_family(record.family))
    near_limit.push_back(without_counts(record));
}

void Tally::note_slow(const TrialRecord& record) {
  if (record.has(Outcome::undecided)) {
    if (undecided.size() < most_undecided) undecided.push_back(without_counts(record));
    return;
  }
  const auto is_slower = [](const TrialRecord& a, const TrialRecord& b) {
    return a.slowest_us != b.slowest_us ? a.slowest_us > b.slowest_us : a.id < b.id;
  };
  if (slowest.size() == most_slowest && !is_slower(record, slowest.back())) return;
  slowest.insert(std::upper_bound(slowest.begin(), slowest.end(), record, is_slower),
                 without_counts(record));
  if (slowest.size() > most_slowest) slowest.pop_back();
}

std::uint64_t Tally::trials() const { return sum_of(*this, &StratumTally::trials); }
std::uint64_t Tally::judged_trials() const {
  return trials() - sum_of(*this, &StratumTally::discards) - sum_of(*this, &StratumTally::refused);
}
std::uint64_t Tally::with_defect() const { return sum_of(*this, &StratumTally::with_defect); }
std::uint64_t Tally::open() const { return sum_of(*this, &StratumTally::open); }
std::uint64_t Tally::disturbed() const { return sum_of(*this, &StratumTally::disturbed); }

void add_law(TrialCounts& counts, const Law& law, const LawTally& tally, std::string_view culling) {
  LawCount count{tally.premise, tally.close, tally.broken_steps, {}};
  if (law.met_under != PremiseScope::any_culling) count.by_culling.emplace(culling, tally.premise);
  counts.laws[std::string(law.name)] += count;
}

std::vector<std::pair<const Law*, LawCount>> laws_in(const TrialCounts& counts, bool built_in) {
  std::vector<std::pair<const Law*, LawCount>> list;
  if (!built_in && counts.laws.empty()) return list;
  for (const auto& law : laws()) {
    if (!built_in && !is_of_plugins(law)) continue;
    const auto place = counts.laws.find(law.name);
    list.emplace_back(&law, place == counts.laws.end() ? LawCount{} : place->second);
  }
  return list;
}

std::vector<std::pair<std::string, std::uint64_t>> premises_by_culling(const LawCount& count,
                                                                       const Law& law) {
  std::vector<std::pair<std::string, std::uint64_t>> list;
  for (const auto culling : all_values<Culling>) {
    if (!is_met_under(culling, law.met_under)) continue;
    const auto place = count.by_culling.find(name_of(culling));
    list.emplace_back(name_of(culling), place == count.by_culling.end() ? 0 : place->second);
  }
  return list;
}

std::string starved(const Law& law, const LawCount& count, std::uint64_t wanted_premises) {
  if (wanted_premises == 0) return "";
  if (count.premise < wanted_premises)
    return fmt::format("the premise of {} held in {} steps, but {} are wanted", law.name,
                       count.premise, wanted_premises);
  if (4 * count.close >= count.premise) return "";
  return fmt::format("the premise of {} was close in {} of {} steps, but a quarter is wanted",
                     law.name, count.close, count.premise);
}

std::vector<std::string> starved_laws(const TrialCounts& counts, std::uint64_t wanted_premises) {
  // Each culling needs a tenth of the steps that are wanted for all cullings together.
  constexpr std::uint64_t least_of_a_culling = 10;
  std::vector<std::string> lines;
  for (const auto& [law, count] : laws_in(counts)) {
    auto line = starved(*law, count, wanted_premises);
    if (!line.empty()) lines.push_back(std::move(line));
    for (const auto& [culling, premise] : premises_by_culling(count, *law)) {
      if (least_of_a_culling * premise >= wanted_premises) continue;
      lines.push_back(fmt::format("the premise of {} held in {} steps under {}, but {} are wanted",
                                  law->name, premise, culling,
                                  (wanted_premises + least_of_a_culling - 1) / least_of_a_culling));
    }
  }
  return lines;
}

std::uint64_t broken_laws(const TrialCounts& counts) {
  const auto laws = laws_in(counts);
  return static_cast<std::uint64_t>(
      std::ranges::count_if(laws, [](const auto& law) { return law.second.broken > 0; }));
}

}  // namespace assay::properties
