#include "properties/first_contact_graph.h"

#include <algorithm>
#include <map>
#include <set>

namespace assay::properties {

using detector::PairContact;
using detector::TrianglePair;

namespace {

// Parts of the contact graph: triangles joined by pairs in contact at the first time.
class FirstContactGraph {
 public:
  FirstContactGraph(const std::vector<PairContact>& pairs, const detector::TimeEnclosure& first) {
    for (const auto& contact : pairs) {
      if (contact.time == first) parent_[root(contact.pair.a)] = root(contact.pair.b);
    }
  }
  std::int32_t root(std::int32_t triangle) {
    const auto [entry, is_new] = parent_.try_emplace(triangle, triangle);
    if (entry->second == triangle) return triangle;
    const auto found = root(entry->second);
    parent_[triangle] = found;
    return found;
  }

 private:
  std::map<std::int32_t, std::int32_t> parent_;
};

}  // namespace

void excuse_beside_the_first(const std::vector<PairContact>& pairs,
                             const detector::TimeEnclosure& first,
                             std::vector<PairContact>& missing, std::vector<PairContact>& excused) {
  FirstContactGraph graph(pairs, first);
  std::set<TrianglePair> lost;
  for (const auto& contact : missing) lost.insert(contact.pair);
  std::set<std::int32_t> reported_parts;
  for (const auto& contact : pairs) {
    if (contact.time == first && !lost.count(contact.pair)) {
      reported_parts.insert(graph.root(contact.pair.a));
    }
  }
  const auto begin =
      std::stable_partition(missing.begin(), missing.end(), [&](const PairContact& contact) {
        return contact.time == first && !reported_parts.count(graph.root(contact.pair.a));
      });
  excused.assign(begin, missing.end());
  missing.erase(begin, missing.end());
}

}  // namespace assay::properties
