// Families of random elementary queries (generators/families.h): generic, degenerate, nearly
// degenerate, and with everyday numbers. The families that ask for contact, and not for distance,
// are the strata of a campaign of queries.
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

// Returns the families of contact: "query-small-int" comes first, "query-extreme" last.
std::span<const Family> query_families();
// Returns the families of the self-test: all families of contact except "query-extreme".
std::span<const Family> self_test_queries();

// Returns the families of distance. Their queries ask whether, and when first, a moving vertex and
// face, or two moving edges, come within d of each other. "distance-generic" comes first. The
// family of parallel edges has only edge-edge queries. No campaign uses these families.
std::span<const Family> distance_families();

// Returns the family of this name, of meshes or of queries of contact; null if there is none.
const Family* find_family(std::string_view name);
bool is_query_family(std::string_view name);
// Returns whether the family draws exponents over all doubles, so that the oracle takes a hundred
// times as long. Of these families only "query-extreme" is a stratum of named campaigns, because it
// has the denormals and exponents of all of them.
bool is_dear_query_family(std::string_view name);

// Returns a random query with exponents over all doubles, for the elementary test and the view
// test: the slowest queries known. The family is fixed: query `index` of `seed` is the same for
// ever, so that the times of two versions can be compared.
//
// Most queries are degenerate, because doubles decide all others. They have few mantissas, many
// zeros, points that coincide or rest, all points in one plane or on one line, roots next to 1 that
// differ only in late bits (see roots_next_to_one), denormals beside ordinary numbers, or
// neighbouring doubles.
QueryTask extreme_contact(std::uint64_t seed, std::uint64_t index);
// Draws the points of an extreme query.
void make_extreme(Random& random, std::span<MovingPoint> points);

// Returns a random query as a case. The index of the query is drawn too, because even and odd
// indices give different kinds of queries.
template <QueryTask (*query)(std::uint64_t seed, std::uint64_t index)>
RandomCase case_of_drawn(Random& random, std::string id) {
  const std::uint64_t seed = random.next();
  const std::uint64_t index = random.next();
  return {case_of_query(query(seed, index).query, std::move(id)), {}};
}

// Returns the row of a family of queries.
template <QueryTask (*query)(std::uint64_t seed, std::uint64_t index)>
constexpr Family family_of(std::string_view name, std::string_view about, int one_in) {
  return {name, about, false, true, case_of_drawn<query>, 0, query, one_in};
}

}  // namespace assay::properties
