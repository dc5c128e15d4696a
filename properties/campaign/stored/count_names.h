// The names under which a campaign counts what it meets in its trials, and what the counts say.
//
// "law:NAME/premise", "/close" and "/broken": steps (law.h). "tag:NAME": cases that have the tag.
// "block:SETS" and "first:SETS": contacts, and first contacts, by the view sets of their two
// triangles. "measure:NAME": what a plug-in does, whatever it claims (step_measures.h).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/campaign/stored/record.h"
#include "properties/laws/law.h"

namespace assay::properties {

std::string tag_count(std::string_view tag);
std::string contact_count(std::string_view sets);
std::string first_contact_count(std::string_view sets);

// 0 where there is none of this name.
std::uint64_t count_of(const Counts& counts, std::string_view name);

void add_law(Counts& counts, std::string_view law, const LawTally& tally);
// What was counted of each law of this build, in the order of laws().
std::vector<std::pair<const Law*, LawTally>> laws_in(const Counts& counts);

std::vector<std::pair<std::string, std::uint64_t>> tags_in(const Counts& counts);

struct SetPairCount {
  std::string sets;
  std::uint64_t contacts = 0, first_contacts = 0;
};
std::vector<SetPairCount> set_pairs_in(const Counts& counts);

// Why a law was met too seldom: its premise held less often than wanted, or was close in less than
// a quarter of the steps. Empty where it was not, and when 0 are wanted.
std::string starved(const Law& law, const LawTally& tally, std::uint64_t wanted_premises);
// A line for each law that is.
std::vector<std::string> starved_laws(const Counts& counts, std::uint64_t wanted_premises);

// How many laws were broken.
std::uint64_t broken_laws(const Counts& counts);

}  // namespace assay::properties
