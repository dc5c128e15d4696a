#include "reports/certificate/fault_facts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace assay::reports {

using Json = nlohmann::ordered_json;

Json median_of_needed(const Json& needed) {
  std::vector<std::uint64_t> cases;
  for (const auto& n : needed) {
    if (!n.is_null()) cases.push_back(n.get<std::uint64_t>());
  }
  const std::size_t middle = (needed.size() - 1) / 2;
  if (needed.empty() || cases.size() <= middle) return nullptr;
  std::sort(cases.begin(), cases.end());
  return cases[middle];
}

bool is_found(const Json& facts) {
  if (facts["curated"].get<bool>()) return true;
  return std::any_of(facts["needed"].begin(), facts["needed"].end(),
                     [](const Json& n) { return !n.is_null(); });
}

}  // namespace assay::reports
