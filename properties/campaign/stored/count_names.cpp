#include "properties/campaign/stored/count_names.h"

#include <fmt/format.h>

#include "properties/judging/case_options.h"

namespace assay::properties {
namespace {

constexpr std::string_view tag_prefix = "tag:", contact_prefix = "block:", first_prefix = "first:";

std::string law_count(std::string_view law, const char* name) {
  return fmt::format("law:{}/{}", law, name);
}
std::string premise_under(std::string_view law, std::string_view culling) {
  return fmt::format("law:{}/premise/{}", law, culling);
}

// Whether a law is to be met under this culling by itself. Laws are met by view sets alone.
bool is_met_under(detector::Culling culling, MetUnder met_under) {
  switch (met_under) {
    case MetUnder::any_culling:
      return false;
    case MetUnder::each_culling:
      return uses_views(culling);
    case MetUnder::each_that_chooses_views:
      return chooses_views(culling);
  }
  return false;
}

// So much of what is wanted of all cullings together is wanted of each.
constexpr std::uint64_t least_of_a_culling = 10;

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

void add_law(Counts& counts, const Law& law, const LawTally& tally, std::string_view culling) {
  counts[law_count(law.name, "premise")] += tally.premise;
  counts[law_count(law.name, "close")] += tally.close;
  counts[law_count(law.name, "broken")] += tally.broken;
  if (law.met_under != MetUnder::any_culling)
    counts[premise_under(law.name, culling)] += tally.premise;
}

std::vector<std::pair<std::string, std::uint64_t>> premises_by_culling(const Counts& counts,
                                                                       const Law& law) {
  std::vector<std::pair<std::string, std::uint64_t>> list;
  for (const auto culling : all_values<detector::Culling>) {
    if (!is_met_under(culling, law.met_under)) continue;
    const std::string name = name_of(culling);
    list.emplace_back(name, count_of(counts, premise_under(law.name, name)));
  }
  return list;
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
    for (const auto& [culling, premise] : premises_by_culling(counts, *law)) {
      if (least_of_a_culling * premise >= wanted_premises) continue;
      lines.push_back(fmt::format("the premise of {} held {} times under {}, {} are wanted",
                                  law->name, premise, culling,
                                  (wanted_premises + least_of_a_culling - 1) / least_of_a_culling));
    }
  }
  return lines;
}

std::uint64_t broken_laws(const Counts& counts) {
  std::uint64_t broken = 0;
  for (const auto& [law, tally] : laws_in(counts)) broken += tally.broken > 0 ? 1 : 0;
  return broken;
}

}  // namespace assay::properties
