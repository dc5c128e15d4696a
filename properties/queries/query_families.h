// Random elementary queries, and the same as families of cases (query_case.h), which are the strata
// of a campaign of queries.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "detector/view/view_filter.h"
#include "properties/generators/families.h"
#include "properties/queries/query_methods.h"

namespace assay::properties {

// The generators: generic, degenerate, just beside degenerate, and with everyday numbers.
//
// Query `index` of `seed` is made from a hash of both alone, so any query can be made again on any
// machine. It is a vertex-face query for even indices, an edge-edge query for odd ones.

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

inline constexpr std::size_t query_generator_count = 10;
// All generators; small-int comes first.
std::span<const QueryGenerator> query_generators();

// One family for each generator, "query-small-int" and so on, and "query-extreme", the last one.
// make_case (families.h) makes their cases, each from its id alone.
std::span<const Family> query_families();

// The family of this name, be it of meshes or of queries; null if there is none.
const Family* find_family(std::string_view name);
bool is_query_family(std::string_view name);
// Whether its exponents are those of all doubles: the oracle takes a hundred times as long. Of
// these families "query-extreme" alone is a stratum of named campaigns: it has denormals and all
// exponents, as the others have.
bool is_dear_query_family(std::string_view name);

// Random queries with exponents over all doubles, for the elementary test and the view test: the
// slowest that are known. The family is fixed: query `index` of `seed` is the same for ever, so
// that the times of two versions can be compared.
//
// Most are degenerate, because doubles settle the others: few mantissas, many zeros, points that
// coincide or stay, everything in one plane or on one line, roots next to 1 that many bits tell
// apart (see roots_next_to_one), denormals beside ordinary numbers, neighbouring doubles.

// A vertex-face query for even indices, an edge-edge query for odd ones.
detector::FourPoints extreme_contact(std::uint64_t seed, std::uint64_t index);

struct ViewQuery {
  detector::MovingTriangle triangle;
  detector::ViewPrimitive primitive;
};
// Seen from a point for even indices, from a line for odd ones.
ViewQuery extreme_view(std::uint64_t seed, std::uint64_t index);

}  // namespace assay::properties
