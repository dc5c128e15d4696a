// The names under which a campaign counts what it meets in its trials, and what the counts say.
//
// The names: "law:NAME/premise", "/close" and "/broken" count steps (law.h). For a law that has to
// be met under several cullings "law:NAME/premise/CULLING" counts them too. "tag:NAME" counts
// cases that have the tag. "block:SETS" and "first:SETS" count contacts, and first contacts, by
// the view sets of their two triangles. "measure:NAME" counts what a plug-in does, whatever it
// claims (step_measures.h).
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

// The count of this name; 0 if there is none.
std::uint64_t count_of(const Counts& counts, std::string_view name);

// culling: the word for it, as in options of the command line.
void add_law(Counts& counts, const Law& law, const LawTally& tally, std::string_view culling);
// What was counted of each law of this build, in the order of laws().
std::vector<std::pair<const Law*, LawTally>> laws_in(const Counts& counts);

// The cullings under which a campaign has to meet the law, each with how often it did; nothing if
// any culling will do.
std::vector<std::pair<std::string, std::uint64_t>> premises_by_culling(const Counts& counts,
                                                                       const Law& law);

std::vector<std::pair<std::string, std::uint64_t>> tags_in(const Counts& counts);

struct SetPairCount {
  std::string sets;
  std::uint64_t contacts = 0, first_contacts = 0;
};
std::vector<SetPairCount> set_pairs_in(const Counts& counts);

// Why a law was met too seldom: its premise held less often than wanted, or was close in less than
// a quarter of the steps. Empty if it was met often enough, or if `wanted_premises` is 0.
std::string starved(const Law& law, const LawTally& tally, std::uint64_t wanted_premises);
// One such line for each law that was met too seldom, and for each culling under which one was met
// in less than a tenth of the steps that are wanted of all.
std::vector<std::string> starved_laws(const Counts& counts, std::uint64_t wanted_premises);

// How many laws were broken.
std::uint64_t broken_laws(const Counts& counts);

}  // namespace assay::properties
