// Random queries of distance: do a moving vertex and face, or two moving edges, come within d of
// each other, and when first? In families: generic, degenerate, and just beside degenerate.
//
// Query `index` of `seed` is made from these two alone, so any query can be made again by its name
// "family:seed:index". It is a vertex-face query for even indices, an edge-edge query for odd ones;
// the family of parallel edges has edges alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "oracle/referee/distance_proofs.h"
#include "properties/queries/query_methods.h"

namespace assay::properties {

struct DistanceQuery {
  Query motion;
  detector::Separation distance = {};  // d
  std::optional<double> near_at;       // a time within d, if the construction knows one
};

struct DistanceFamily {
  const char* name;
  const char* about;
  DistanceQuery (*make)(std::uint64_t seed, std::uint64_t index);
  double most_open;  // the share of its queries that the referee may leave open
  int one_in;        // one for each `one_in` of the first family: the dearer, the fewer
};

// All families; distance-generic comes first.
std::span<const DistanceFamily> distance_families();

// d and the motion, all numbers as hexadecimal doubles.
std::string exact_text(const DistanceQuery& query);

}  // namespace assay::properties
