// Families of random elementary queries (generators/families.h): generic, degenerate, just beside
// degenerate, and with everyday numbers. Those of contact are the strata of a campaign of queries.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/queries/query_methods.h"
#include "properties/random.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

// Queries of contact: "query-small-int" comes first, "query-extreme" last.
std::span<const Family> query_families();
// Those of the self-test: all but "query-extreme".
std::span<const Family> self_test_queries();

// Queries of distance: do a moving vertex and face, or two moving edges, come within d of each
// other, and when first? "distance-generic" comes first. The family of parallel edges has edges
// alone. No campaign asks them.
std::span<const Family> distance_families();

// The family of this name, be it of meshes or of contacts of queries; null if there is none.
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
QueryTask extreme_contact(std::uint64_t seed, std::uint64_t index);
// The points of such a query.
void make_extreme(Random& random, std::span<detector::MovingPoint> points);

// The query as a case. Its place is drawn too, because even and odd places are of two kinds.
template <QueryTask (*query)(std::uint64_t seed, std::uint64_t index)>
RandomCase case_of_drawn(Random& random, std::string id) {
  const std::uint64_t seed = random.next();
  const std::uint64_t index = random.next();
  return {case_of_query(query(seed, index).query, std::move(id)), {}};
}

// A row of such a family.
template <QueryTask (*query)(std::uint64_t seed, std::uint64_t index)>
constexpr Family family_of(std::string_view name, std::string_view about, int one_in) {
  return {name, about, false, true, case_of_drawn<query>, 0, query, one_in};
}

}  // namespace assay::properties
