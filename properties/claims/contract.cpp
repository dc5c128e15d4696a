#include "properties/claims/contract.h"

#include <fmt/format.h>

#include <cmath>

#include "properties/words.h"

namespace assay::properties {

const char* name_of(Adjacency adjacency) {
  return word_of({"all", "not-edge-sharing", "no-shared-vertex"}, adjacency);
}

const char* name_of(Coordinates coordinates) {
  return word_of({"float64", "float32"}, coordinates);
}

const char* name_of(StartRule start) { return word_of({"any", "free", "apart"}, start); }

const char* name_of(TestedFeatures features) {
  return word_of({"both", "vertex-face", "edge-edge"}, features);
}

namespace {

bool is_length(double x) { return std::isfinite(x) && x >= 0; }

}  // namespace

std::string fault_of(const Contract& contract) {
  if (!is_length(contract.margin)) return "its margin is no length";
  if (!is_length(contract.start_distance)) return "its start_distance is no length";
  if (contract.start == StartRule::apart && contract.start_distance == 0)
    return "it starts apart, by a start_distance of 0";
  if (contract.start != StartRule::apart && contract.start_distance > 0)
    return "it has a start_distance, and does not start apart";
  if (!is_length(contract.least_nonzero) || !is_length(contract.largest))
    return "its range of coordinates is none";
  if (contract.least_nonzero > contract.largest)
    return fmt::format("its range of coordinates is upside down: from {} to {}",
                       contract.least_nonzero, contract.largest);
  if (!(contract.time_tolerance >= 0)) return "its time_tolerance is no time";
  if (contract.time_tolerance > widest_time_tolerance)
    return fmt::format("its time_tolerance {} is above {}", contract.time_tolerance,
                       widest_time_tolerance);
  return "";
}

std::vector<std::string> phrases_of(const Contract& contract) {
  std::vector<std::string> list;
  if (contract.adjacency != Adjacency::all)
    list.push_back(fmt::format("neighbours {}", name_of(contract.adjacency)));
  if (contract.coordinates != Coordinates::float64)
    list.push_back(fmt::format("coordinates {}", name_of(contract.coordinates)));
  if (contract.margin > 0) list.push_back(fmt::format("margin {}", contract.margin));
  if (contract.start == StartRule::free) list.emplace_back("starts free");
  if (contract.start == StartRule::apart)
    list.push_back(fmt::format("starts {} apart", contract.start_distance));
  if (contract.has_range())
    list.push_back(
        fmt::format("coordinates from {} to {}", contract.least_nonzero, contract.largest));
  if (contract.features != TestedFeatures::both)
    list.push_back(fmt::format("{} alone", name_of(contract.features)));
  if (contract.time_tolerance > 0)
    list.push_back(fmt::format("times within {}", contract.time_tolerance));
  if (!contract.reports_pairs) list.emplace_back("no pairs");
  return list;
}

int shared_vertices(const detector::TrianglesView& triangles, detector::TrianglePair pair) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) shared += triangles(pair.a, i) == triangles(pair.b, j) ? 1 : 0;
  }
  return shared;
}

bool leaves_out(const Contract& contract, const detector::TrianglesView& triangles,
                detector::TrianglePair pair) {
  if (contract.adjacency == Adjacency::all) return false;
  const int most_shared = contract.adjacency == Adjacency::not_edge_sharing ? 1 : 0;
  return shared_vertices(triangles, pair) > most_shared;
}

detector::Positions contracted(const detector::PositionsView& x, Coordinates coordinates) {
  if (coordinates == Coordinates::float64) return x;
  return x.cast<float>().cast<double>();
}

bool in_range(const detector::PositionsView& x, const Contract& contract) {
  if (!contract.has_range()) return true;
  const auto magnitudes = x.array().abs();
  return ((magnitudes == 0) ||
          (magnitudes >= contract.least_nonzero && magnitudes <= contract.largest))
      .all();
}

}  // namespace assay::properties
