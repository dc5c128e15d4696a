// Random queries of distance: do a moving vertex and face, or two moving edges, come within d of
// each other, and when first? In families: generic, degenerate, and just beside degenerate.
//
// Query `index` of `seed` is made from these two alone, so any query can be made again by its name
// "family:seed:index". It is a vertex-face query for even indices, an edge-edge query for odd ones;
// the family of parallel edges has edges alone.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "oracle/referee/distance_referee.h"
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

// A method that answers these is compared with the oracle's distance referee.

struct DistanceAnswer {
  bool is_near = false;           // within d at some time of the step
  detector::TimeEnclosure first;  // set if it is near
};

using DistanceMethod = std::function<DistanceAnswer(const DistanceQuery&)>;

// What a family of queries came to.
struct DistanceTally {
  std::uint64_t queries = 0, near = 0, far = 0, open = 0;  // by the referee's verdicts
  std::uint64_t contradictions = 0;
  std::uint64_t cells = 0, most_cells = 0;  // that the referee looked at; in its dearest query
  double open_share() const {
    return queries == 0 ? 0 : static_cast<double>(open) / static_cast<double>(queries);
  }
  DistanceTally& operator+=(const DistanceTally& other);
};

oracle::DistanceVerdict ask_distance_referee(const DistanceQuery& query,
                                             const oracle::DistanceRefereeOptions& options = {});

// What of an answer is refuted by the verdict, or by the time that the construction knows; nothing
// if both may be right. A verdict that is open refutes an answer too, if its first time lies where
// the referee has proved that nothing is near.
std::optional<std::string> contradiction(const DistanceQuery& query, const DistanceAnswer& answer,
                                         const oracle::DistanceVerdict& verdict);

// The same of a verdict alone.
std::optional<std::string> contradiction(const DistanceQuery& query,
                                         const oracle::DistanceVerdict& verdict);

// Asks the method and the referee. Without a method only the referee's own verdict is looked at.
// A method that throws contradicts.
std::optional<std::string> check_distance(const DistanceQuery& query, const DistanceMethod& method,
                                          DistanceTally& tally);

}  // namespace assay::properties
