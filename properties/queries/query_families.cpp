#include "properties/queries/query_families.h"

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "properties/queries/extreme_queries.h"
#include "properties/queries/query_generators.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// The place of a query in its generator's sequence is drawn too, because even and odd places are
// of the two kinds.
template <std::size_t generator>
GeneratedCase make_query(Random& random, std::string id) {
  const std::uint64_t seed = random.next();
  const std::uint64_t index = random.next();
  const auto made = query_generators()[generator].make(seed, index);
  return {case_of_query(made.query, std::move(id)), {}};
}

GeneratedCase make_extreme(Random& random, std::string id) {
  const std::uint64_t seed = random.next();
  const std::uint64_t index = random.next();
  return {case_of_query(extreme_contact(seed, index), std::move(id)), {}};
}

struct QueryFamilies {
  std::deque<std::string> names;
  std::vector<Family> list;

  void add(std::string_view name, std::string_view about,
           GeneratedCase (*make)(Random&, std::string)) {
    names.push_back("query-" + std::string(name));
    list.push_back({names.back(), about, false, true, make});
  }

  template <std::size_t... generator>
  void add_generators(std::index_sequence<generator...>) {
    (add(query_generators()[generator].name, query_generators()[generator].about,
         make_query<generator>),
     ...);
  }

  QueryFamilies() {
    add_generators(std::make_index_sequence<query_generator_count>());
    add("extreme", "few mantissas, exponents over all doubles, mostly degenerate", make_extreme);
  }
};

}  // namespace

std::span<const Family> query_families() {
  static const QueryFamilies families;
  return families.list;
}

const Family* find_family(std::string_view name) {
  for (const auto known : {families(), query_families()}) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Family& f) { return f.name == name; });
    if (found != known.end()) return &*found;
  }
  return nullptr;
}

bool is_query_family(std::string_view name) {
  const auto known = query_families();
  return std::any_of(known.begin(), known.end(), [&](const Family& f) { return f.name == name; });
}

}  // namespace assay::properties
