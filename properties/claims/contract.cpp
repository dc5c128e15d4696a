#include "properties/claims/contract.h"

#include <charconv>
#include <cmath>

namespace assay::properties {

std::string number_text(double x) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), x).ptr;
  return {text, end};
}

namespace {

bool is_length(double x) { return std::isfinite(x) && x >= 0; }

}  // namespace

std::string fault_of(const Contract& contract) {
  if (!is_length(contract.margin)) return "its margin is no length";
  if (!is_length(contract.separation)) return "its separation is no length";
  if (contract.separation > 0 && contract.adjacency != Adjacency::no_shared_vertex)
    return "it has a separation, but tests neighbours, which are within every separation";
  if (!is_length(contract.start_distance)) return "its start_distance is no length";
  if (contract.start == StartRule::apart && contract.start_distance == 0)
    return "its start is `apart`, but its start_distance is 0";
  if (contract.start != StartRule::apart && contract.start_distance > 0)
    return "it has a start_distance, but its start is not `apart`";
  if (!is_length(contract.least_nonzero) || !is_length(contract.largest))
    return "its range of coordinates is invalid";
  if (contract.least_nonzero > contract.largest)
    return "its range of coordinates is upside down: from " + number_text(contract.least_nonzero) +
           " to " + number_text(contract.largest);
  if (contract.rings < 0) return "its rings are below 0";
  if (!is_length(contract.rest_distance)) return "its rest_distance is no length";
  if (!(contract.progress >= 0 && contract.progress <= 1))
    return "its progress is no share from 0 to 1";
  if (contract.motion == MotionGiven::displacement && contract.coordinates != Coordinates::float32)
    return "its motion is a displacement, but its coordinates are not float32";
  if (contract.motion == MotionGiven::displacement && contract.limit_gives == LimitGives::blend)
    return "its limit_gives is `blend`, but its motion is a displacement";
  if (!(contract.time_tolerance >= 0)) return "its time_tolerance is no time";
  if (contract.time_tolerance > widest_time_tolerance)
    return "its time_tolerance " + number_text(contract.time_tolerance) + " is above " +
           number_text(widest_time_tolerance);
  return "";
}

std::vector<std::string> phrases_of(const Contract& contract) {
  std::vector<std::string> list;
  const auto say = [&](const char* name, const std::string& value, const char* behind = "") {
    list.push_back(std::string(name).append(value).append(behind));
  };
  if (contract.adjacency != Adjacency::all) say("neighbours ", name_of(contract.adjacency));
  if (contract.coordinates != Coordinates::float64)
    say("coordinates ", name_of(contract.coordinates));
  if (contract.motion != MotionGiven::ends) say("motion ", name_of(contract.motion));
  if (contract.separation > 0) say("within ", number_text(contract.separation));
  if (contract.margin > 0) say("margin ", number_text(contract.margin));
  if (contract.start == StartRule::free) list.emplace_back("starts free");
  if (contract.start == StartRule::apart)
    say("starts ", number_text(contract.start_distance), " apart");
  if (contract.least_nonzero > 0) say("edges from ", number_text(contract.least_nonzero));
  if (contract.has_range()) say("coordinates up to ", number_text(contract.largest));
  if (contract.features != TestedFeatures::both) say("", name_of(contract.features), " alone");
  if (contract.time_tolerance > 0) say("times within ", number_text(contract.time_tolerance));
  const char* level = name_of(contract.counts);
  if (contract.rings > 0)
    say(level, " beyond " + std::to_string(contract.rings),
        contract.rings == 1 ? " ring" : " rings");
  if (contract.rest_distance > 0)
    say(level, " from " + number_text(contract.rest_distance), " apart at rest");
  if (!contract.reports_pairs()) list.emplace_back("no pairs");
  if (contract.progress > 0) say("progress ", number_text(contract.progress));
  if (contract.limit_gives != LimitGives::positions)
    say("stops at ", name_of(contract.limit_gives));
  const auto say_capacity = [&](std::uint64_t most, const char* of) {
    if (most > 0) say("capacity ", std::to_string(most), of);
  };
  say_capacity(contract.capacity_triangles, " triangles");
  say_capacity(contract.capacity_contacts, " contacts");
  say_capacity(contract.capacity_candidates, " candidates");
  return list;
}

bool beyond_capacity(const Contract& contract, const StepLoad& load) {
  const auto exceeds = [](std::uint64_t number, std::uint64_t most) {
    return most > 0 && number > most;
  };
  return exceeds(load.triangles, contract.capacity_triangles) ||
         exceeds(load.contacts, contract.capacity_contacts) ||
         exceeds(load.candidates, contract.capacity_candidates);
}

CountedPairs tested_pairs(const Contract& contract, const Positions& rest) {
  CountedPairs pairs;
  pairs.level = contract.counts;
  pairs.rings = contract.rings;
  pairs.rest_distance = contract.rest_distance;
  if (contract.rest_distance > 0) pairs.rest = corpus::points_of(rest);
  return pairs;
}

int shared_vertices(const TrianglesView& triangles, TrianglePair pair) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) shared += triangles(pair.a, i) == triangles(pair.b, j) ? 1 : 0;
  }
  return shared;
}

bool leaves_out(const Contract& contract, const TrianglesView& triangles, TrianglePair pair) {
  if (contract.adjacency == Adjacency::all) return false;
  const int most_shared = contract.adjacency == Adjacency::not_edge_sharing ? 1 : 0;
  return shared_vertices(triangles, pair) > most_shared;
}

Positions round_to(const PositionsView& x, Coordinates coordinates) {
  if (coordinates == Coordinates::float64) return x;
  // Two steps, through memory: g++ 12 drops two conversions in a row where it vectorises.
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> rounded = x.cast<float>();
  return rounded.cast<double>();
}

Positions displacement(const PositionsView& x_t0, const PositionsView& x_t1) {
  return round_to(x_t1 - x_t0, Coordinates::float32);
}

double length_of(const PositionsView& x, const Edge& edge) {
  return (x.row(edge[0]) - x.row(edge[1])).cwiseAbs().maxCoeff();
}

std::string beyond_range(const PositionsView& x, const std::vector<Edge>& edges,
                         const Contract& contract) {
  if (!contract.has_range()) return "";
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (std::abs(x(v, k)) <= contract.largest) continue;
      return "vertex " + std::to_string(v) + " has the coordinate " + number_text(x(v, k)) +
             ", above largest, " + number_text(contract.largest);
    }
  }
  for (const Edge& edge : edges) {
    const double length = length_of(x, edge);
    if (length == 0 || length >= contract.least_nonzero) continue;
    return "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]) + " is " +
           number_text(length) + " long, below least_nonzero, " +
           number_text(contract.least_nonzero);
  }
  return "";
}

}  // namespace assay::properties
