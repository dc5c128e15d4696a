// The contract of a detector: the steps, coordinates and features that it accepts, and the
// tolerances with which its answers are judged.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "detector/plugin/assay_detector.h"
#include "properties/fields.h"
#include "properties/words.h"

namespace assay::properties {

// Which neighbours a detector tests against each other.
enum class Adjacency : std::uint8_t {
  all,               // every pair of triangles
  not_edge_sharing,  // pairs that share at most one vertex
  no_shared_vertex,  // pairs that share nothing
};
constexpr auto names_of(Adjacency) {
  using enum Adjacency;
  return std::to_array<Named<Adjacency>>({{all, "all"},
                                          {not_edge_sharing, "not-edge-sharing"},
                                          {no_shared_vertex, "no-shared-vertex"}});
}

// The coordinates that the detector computes with. Inputs of a float32 detector are rounded to the
// nearest float32 before the detector and the oracle see them.
enum class Coordinates : std::uint8_t { float64, float32 };
constexpr auto names_of(Coordinates) {
  return std::to_array<Named<Coordinates>>(
      {{Coordinates::float64, "float64"}, {Coordinates::float32, "float32"}});
}

// Which steps the detector takes, by the state of the mesh at t = 0. Other steps are left out, and
// counted.
enum class StartRule : std::uint8_t {
  any,    // every step
  free,   // steps that start without a contact
  apart,  // steps that start with all features at least start_distance apart
};
constexpr auto names_of(StartRule) {
  using enum StartRule;
  return std::to_array<Named<StartRule>>({{any, "any"}, {free, "free"}, {apart, "apart"}});
}

// Which features the detector tests against each other. It is no defect if the detector misses a
// contact of other features.
enum class TestedFeatures : std::uint8_t { both, vertex_face, edge_edge };
constexpr auto names_of(TestedFeatures) {
  using enum TestedFeatures;
  return std::to_array<Named<TestedFeatures>>(
      {{both, "both"}, {vertex_face, "vertex-face"}, {edge_edge, "edge-edge"}});
}

// How the motion of a step is given to a detector.
enum class MotionGiven : std::uint8_t {
  ends,          // by the positions at t = 1
  displacement,  // by the displacement; the positions at t = 1 are its exact sum with x_t0
};
constexpr auto names_of(MotionGiven) {
  return std::to_array<Named<MotionGiven>>(
      {{MotionGiven::ends, "ends"}, {MotionGiven::displacement, "displacement"}});
}

// Where a limiter that states a share of a step lets the caller stop (L17).
enum class LimitGives : std::uint8_t {
  positions,   // at the positions that the limiter gives
  start_plus,  // x_t0 + share (x_t1 - x_t0), in the contract's coordinates
  blend,       // (1 - share) x_t0 + share x_t1
};
constexpr auto names_of(LimitGives) {
  using enum LimitGives;
  return std::to_array<Named<LimitGives>>(
      {{positions, "positions"}, {start_plus, "start-plus"}, {blend, "blend"}});
}

// Whether a detector names the pairs that meet.
enum class PairReporting : std::uint8_t { pairs, no_pairs };
constexpr auto names_of(PairReporting) {
  return std::to_array<Named<PairReporting>>(
      {{PairReporting::pairs, "pairs"}, {PairReporting::no_pairs, "no-pairs"}});
}

// The greatest time tolerance of a contract. A contract with a greater tolerance is refused.
inline constexpr double widest_time_tolerance = 1e-3;

// Lengths are in the user's units; times are shares of the step. The default contract leaves
// nothing out.
struct Contract {
  Adjacency adjacency = Adjacency::all;
  Coordinates coordinates = Coordinates::float64;
  // The detector may also report pairs that come within separation + margin. If margin > 0,
  // first-time is not judged, and no-spurious is judged only if the detector leaves neighbours out,
  // because neighbours are always within the margin of each other.
  double margin = 0;
  StartRule start = StartRule::any;
  double start_distance = 0;  // for StartRule::apart
  // The range of meshes that the detector accepts. No coordinate has a magnitude above `largest`,
  // because rounding depends on coordinates. Every edge has the length 0 or a length of at least
  // least_nonzero, because thresholds depend on lengths. The length of an edge is its greatest
  // extent along an axis. If least_nonzero and `largest` are 0, the detector accepts any mesh.
  double least_nonzero = 0, largest = 0;
  TestedFeatures features = TestedFeatures::both;
  double time_tolerance = 0;  // a time is late, early or wrong if its error is more than this
  PairReporting reports = PairReporting::pairs;
  // If above 0, the question is which triangles come within this distance, instead of which touch,
  // and only pairs that share no vertex are asked for.
  double separation = 0;
  // The pairs that the detector leaves out by itself, in the terms of
  // detector/mesh/counted_pairs.h, at the level `counts`. The mesh is at rest in the frame from
  // which a detector is made.
  detector::CountedLevel counts = detector::CountedLevel::triangles;
  std::int32_t rings = 0;
  double rest_distance = 0;
  // Whether the host can tell the detector which pairs count. If not, the detector is asked about
  // all pairs.
  bool takes_relations = true;
  // For a limiter: where a caller stops who gets only a share; and the share of the first contact
  // time that the limiter promises to allow (Claim::progress), or 0 if it promises none.
  LimitGives limit_gives = LimitGives::positions;
  double progress = 0;
  // MotionGiven::displacement REQUIRES float32 coordinates, so that the exact sum of x_t0 and the
  // displacement consists of doubles, which the oracle needs.
  MotionGiven motion = MotionGiven::ends;
  // The capacity of the detector; 0: unlimited. The detector may refuse a step that exceeds one of
  // these numbers (beyond_capacity).
  std::uint64_t capacity_triangles = 0, capacity_contacts = 0, capacity_candidates = 0;
  friend bool operator==(const Contract&, const Contract&) = default;

  bool has_range() const { return largest > 0; }
  bool reports_pairs() const { return reports == PairReporting::pairs; }
  // Returns whether false alarms are judged. They are judged in every query, because the features
  // of a query share no vertex.
  bool judges_alarms(bool of_queries = false) const {
    return margin == 0 || of_queries || adjacency == Adjacency::no_shared_vertex;
  }
  // Returns whether the detector tests only a part of the contacts, so that the oracle must list
  // that part separately (StepJudgement::asked_pairs).
  bool tests_part() const {
    return features != TestedFeatures::both || rings > 0 || rest_distance > 0;
  }
};

// Calls visit(name, member of the description, member of the contract) for each member of the
// contract that an assay_description states. The description has a number in place of an enum.
template <class Description, class Visit>
void visit_members(Description& raw, Contract& contract, const Visit& visit) {
#define ASSAY_NAME(kind, name, since) name,
#define ASSAY_VISIT(kind, name, since) visit(#name, raw.name, contract.name);
  // This compiles only if ASSAY_CONTRACT_MEMBERS lists all members except takes_relations.
  [[maybe_unused]] const auto& [ASSAY_CONTRACT_MEMBERS(ASSAY_NAME) takes_relations] = contract;
  ASSAY_CONTRACT_MEMBERS(ASSAY_VISIT)
#undef ASSAY_NAME
#undef ASSAY_VISIT
}

// Visits each member by its name, for reports, certificates and messages. The archive gets a bool
// `reports_pairs` in place of the member `reports`.
template <class Archive>
void fields(Archive& archive, Contract& x) {
  assay_description unused = {};
  bool reports_pairs = x.reports_pairs();
  visit_members(unused, x, [&](std::string_view name, auto&, auto& member) {
    if (name == "reports") return archive("reports_pairs", reports_pairs);
    archive(name.data(), member);
    if (name == "rest_distance") archive("takes_relations", x.takes_relations);
  });
  x.reports = reports_pairs ? PairReporting::pairs : PairReporting::no_pairs;
}

// Returns the shortest decimal that reads back to the same double. This function does not use
// libfmt, because the worker does not link that library.
std::string number_text(double x);

// Returns the fault of the contract in words ("its margin is no length"); empty if it has none.
std::string fault_of(const Contract& contract);

// Returns one phrase for each thing that the contract leaves out or changes: "starts free", "edges
// from 1e-06", "coordinates up to 1e+06", "times within 1e-09". Empty for the contract that leaves
// nothing out.
std::vector<std::string> phrases_of(const Contract& contract);

// The load of a step, as the oracle counts it: triangles of its mesh, pairs of triangles in contact
// that the contract does not leave out, and feature pairs whose swept boxes meet.
struct StepLoad {
  std::uint64_t triangles = 0, contacts = 0, candidates = 0;
};
// Returns whether a detector with this contract may refuse a step with this load.
bool beyond_capacity(const Contract& contract, const StepLoad& load);

// Returns the relation of the pairs that the detector tests under the contract, on a mesh whose
// vertices are at rest at `rest`.
CountedPairs tested_pairs(const Contract& contract, const Positions& rest);

int shared_vertices(const TrianglesView& triangles, TrianglePair pair);

// Returns whether the contract's adjacency alone lets the detector leave this pair out.
bool leaves_out(const Contract& contract, const TrianglesView& triangles, TrianglePair pair);

// Returns the positions rounded to these coordinates, as both the detector and the oracle get them.
// A coordinate beyond the range of float32 becomes infinite.
Positions round_to(const PositionsView& x, Coordinates coordinates);

// Returns the displacement that a float32 detector gets for a step: the difference x_t1 - x_t0 in
// doubles, rounded to float32.
Positions displacement(const PositionsView& x_t0, const PositionsView& x_t1);

using Edge = std::array<std::int32_t, 2>;

double length_of(const PositionsView& x, const Edge& edge);

// Returns where a mesh with these edges leaves the contract's range, with the member of the
// contract: "vertex 3 has the coordinate 2e+06, above largest, 1e+06" or "edge 3-4 is 2e-13 long,
// below least_nonzero, 1e-06". Empty if the mesh is within the range.
std::string beyond_range(const PositionsView& x, const std::vector<Edge>& edges,
                         const Contract& contract);

}  // namespace assay::properties
