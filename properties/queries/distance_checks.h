// Compares a method that answers queries of distance with the oracle's distance referee.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "oracle/referee/distance_referee.h"
#include "properties/queries/distance_queries.h"

namespace assay::properties {

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
