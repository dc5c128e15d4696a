#include "properties/campaign/stored/count_names.h"

#include <fmt/format.h>

namespace assay::properties {
namespace {

constexpr std::string_view tag_prefix = "tag:", contact_prefix = "block:", first_prefix = "first:";

std::string law_count(std::string_view law, const char* name) {
  return fmt::format("law:{}/{}", law, name);
}

LawTally tally_of(const Counts& counts, std::string_view law) {
  LawTally tally;
  tally.premise = count_of(counts, law_count(law, "premise"));
  tally.close = count_of(counts, law_count(law, "close"));
  tally.broken = count_of(counts, law_count(law, "broken"));
  return tally;
}

// The names that begin with the prefix, without it, and their counts.
std::vector<std::pair<std::string, std::uint64_t>> behind(const Counts& counts,
                                                          std::string_view prefix) {
  std::vector<std::pair<std::string, std::uint64_t>> list;
  for (auto it = counts.lower_bound(prefix); it != counts.end() && it->first.starts_with(prefix);
       ++it)
    list.emplace_back(it->first.substr(prefix.size()), it->second);
  return list;
}

}  // namespace

std::string tag_count(std::string_view tag) { return fmt::format("{}{}", tag_prefix, tag); }
std::string contact_count(std::string_view sets) {
  return fmt::format("{}{}", contact_prefix, sets);
}
std::string first_contact_count(std::string_view sets) {
  return fmt::format("{}{}", first_prefix, sets);
}

std::uint64_t count_of(const Counts& counts, std::string_view name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

void add_law(Counts& counts, std::string_view law, const LawTally& tally) {
  counts[law_count(law, "premise")] += tally.premise;
  counts[law_count(law, "close")] += tally.close;
  counts[law_count(law, "broken")] += tally.broken;
}

std::vector<std::pair<const Law*, LawTally>> laws_in(const Counts& counts) {
  std::vector<std::pair<const Law*, LawTally>> list;
  for (const auto& law : laws()) list.emplace_back(&law, tally_of(counts, law.name));
  return list;
}

std::vector<std::pair<std::string, std::uint64_t>> tags_in(const Counts& counts) {
  return behind(counts, tag_prefix);
}

std::vector<SetPairCount> set_pairs_in(const Counts& counts) {
  std::vector<SetPairCount> list;
  for (const auto& [sets, contacts] : behind(counts, contact_prefix))
    list.push_back({sets, contacts, count_of(counts, first_contact_count(sets))});
  return list;
}

std::string starved(const Law& law, const LawTally& tally, std::uint64_t wanted_premises) {
  if (wanted_premises == 0) return "";
  if (tally.premise < wanted_premises)
    return fmt::format("the premise of {} held {} times, {} are wanted", law.name, tally.premise,
                       wanted_premises);
  if (4 * tally.close >= tally.premise) return "";
  return fmt::format("{} was close in {} of {} cases, a quarter is wanted", law.name, tally.close,
                     tally.premise);
}

std::vector<std::string> starved_laws(const Counts& counts, std::uint64_t wanted_premises) {
  std::vector<std::string> lines;
  for (const auto& [law, tally] : laws_in(counts)) {
    auto line = starved(*law, tally, wanted_premises);
    if (!line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::uint64_t broken_laws(const Counts& counts) {
  std::uint64_t broken = 0;
  for (const auto& [law, tally] : laws_in(counts)) broken += tally.broken > 0 ? 1 : 0;
  return broken;
}

}  // namespace assay::properties
