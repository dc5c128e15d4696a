#include "properties/judging/first_contact_graph.h"

#include <algorithm>
#include <set>

#include "properties/judging/contact_parts.h"

namespace assay::properties {

void excuse_beside_the_first(const std::vector<detector::PairContact>& pairs,
                             const detector::TimeEnclosure& first,
                             std::vector<detector::PairContact>& missing,
                             std::vector<detector::PairContact>& excused) {
  std::set<detector::TrianglePair> lost, of_lost_parts;
  for (const auto& contact : missing) lost.insert(contact.pair);
  const auto is_lost = [&](const auto& contact) { return lost.contains(contact.pair); };
  for (const auto& part : contact_parts(pairs, first)) {
    if (!std::all_of(part.begin(), part.end(), is_lost)) continue;
    for (const auto& contact : part) of_lost_parts.insert(contact.pair);
  }
  const auto begin = std::stable_partition(
      missing.begin(), missing.end(),
      [&](const auto& contact) { return of_lost_parts.contains(contact.pair); });
  excused.assign(begin, missing.end());
  missing.erase(begin, missing.end());
}

}  // namespace assay::properties
