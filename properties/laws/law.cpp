#include "properties/laws/law.h"

#include <algorithm>
#include <vector>

#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

LawTally& LawTally::operator+=(const LawTally& other) {
  premise += other.premise;
  close += other.close;
  broken += other.broken;
  if (first_broken.empty() || (!other.first_broken.empty() && other.first_broken < first_broken)) {
    first_broken = other.first_broken;
  }
  return *this;
}

std::span<const Law> laws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> list;
    for (const auto group : law_groups()) list.insert(list.end(), group.begin(), group.end());
    return list;
  }();
  return all;
}

bool is_checked_on(const Law& law, std::string_view case_id) {
  return Random(Random::hash(case_id), Random::hash(law.name)).one_in(law.one_in);
}

const Law* law_named(std::string_view name) {
  const auto all = laws();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Law& law) { return law.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace assay::properties
