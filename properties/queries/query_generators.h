// Random elementary queries, by family: generic, degenerate, and just beside degenerate.
//
// Query `index` of `seed` is made from a hash of both alone, so any query can be made again on any
// machine. It is a vertex-face query for even indices, an edge-edge query for odd ones.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "properties/queries/query_methods.h"

namespace assay::properties {

struct GeneratedQuery {
  Query query;
  std::optional<double> contact_at;  // a time of contact, if the construction knows one
};

struct QueryGenerator {
  const char* name;
  const char* about;
  GeneratedQuery (*make)(std::uint64_t seed, std::uint64_t index);
  int one_in;  // one for each `one_in` of small-int: the dearer, the fewer
};

inline constexpr std::size_t query_generator_count = 9;
// All generators; small-int comes first.
std::span<const QueryGenerator> query_generators();

}  // namespace assay::properties
