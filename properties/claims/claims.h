// What a detector promises: the contract under which its claims hold (which steps, coordinates and
// features it takes, and how its times are read), its claims, and what else a plug-in says of
// itself.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"
#include "detector/options.h"
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

// Which steps the detector takes, by how the mesh lies at t = 0. The others are left out, and
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

// Which features the detector tests against each other. Contacts of the others are not held
// against it.
enum class TestedFeatures : std::uint8_t { both, vertex_face, edge_edge };
constexpr auto names_of(TestedFeatures) {
  using enum TestedFeatures;
  return std::to_array<Named<TestedFeatures>>(
      {{both, "both"}, {vertex_face, "vertex-face"}, {edge_edge, "edge-edge"}});
}

// How a detector is told where a step goes.
enum class MotionGiven : std::uint8_t {
  ends,          // by the positions at its end
  displacement,  // by what is added to those at its start; the exact sum is the end
};
constexpr auto names_of(MotionGiven) {
  return std::to_array<Named<MotionGiven>>(
      {{MotionGiven::ends, "ends"}, {MotionGiven::displacement, "displacement"}});
}

// Where a limiter that states a share of a step lets the caller stop (L17).
enum class LimitGives : std::uint8_t {
  positions,   // where it says itself
  start_plus,  // x_t0 + share (x_t1 - x_t0), in the contract's coordinates
  blend,       // (1 - share) x_t0 + share x_t1
};
constexpr auto names_of(LimitGives) {
  using enum LimitGives;
  return std::to_array<Named<LimitGives>>(
      {{positions, "positions"}, {start_plus, "start-plus"}, {blend, "blend"}});
}

// A contract that asks for more is refused.
inline constexpr double widest_time_tolerance = 1e-3;

// Lengths are in the user's units; times are shares of the step. The default contract leaves
// nothing out.
struct Contract {
  Adjacency adjacency = Adjacency::all;
  Coordinates coordinates = Coordinates::float64;
  // The slack m: the detector may also report what comes within separation + m. Above 0, first-time
  // is not judged, and no-spurious is only if the detector leaves neighbours out: these are within
  // m of each other throughout.
  double margin = 0;
  StartRule start = StartRule::any;
  double start_distance = 0;  // for StartRule::apart
  // No coordinate has a magnitude above `largest`, because rounding goes by the coordinates. Every
  // edge has length 0 or at least least_nonzero, because thresholds go by lengths; length is the
  // greatest difference along an axis. The extent of a mesh is that of an edge at least. Both 0:
  // any mesh.
  double least_nonzero = 0, largest = 0;
  TestedFeatures features = TestedFeatures::both;
  double time_tolerance = 0;  // a time is late, early or wrong when it is off by more than this
  bool reports_pairs = true;
  // Above 0: the question is not which triangles touch, but which come within this distance. Then
  // pairs that share no vertex are asked for alone.
  double separation = 0;
  // What the detector leaves out by itself, as members of detector/mesh/counted_pairs.h, at the
  // level `counts`. At rest the mesh is as in the frame that a detector is made from.
  detector::CountedLevel counts = detector::CountedLevel::triangles;
  std::int32_t rings = 0;
  double rest_distance = 0;
  // Whether the detector can be told which pairs count. One that cannot is asked about all pairs.
  bool takes_relations = true;
  // Of a limiter: where the caller stops who is told a share alone, and what share of the first
  // contact time it promises (Claim::progress); 0: none.
  LimitGives limit_gives = LimitGives::positions;
  double progress = 0;
  // Displacements are in float32 alone: the end of a step is then a double, in which the oracle
  // holds it.
  MotionGiven motion = MotionGiven::ends;
  // How much the detector holds; 0: as much as there is. Beyond one of them a step may be refused
  // (beyond_capacity).
  std::uint64_t capacity_triangles = 0, capacity_contacts = 0, capacity_candidates = 0;
  friend bool operator==(const Contract&, const Contract&) = default;

  bool has_range() const { return largest > 0; }
  // Whether it is judged what the detector reports although it is not there. The features of a
  // query share no vertex.
  bool judges_alarms(bool of_queries = false) const {
    return margin == 0 || of_queries || adjacency == Adjacency::no_shared_vertex;
  }
  // Whether the oracle has to tell contacts that the detector tests from others
  // (StepJudgement::asked_pairs).
  bool tests_part() const {
    return features != TestedFeatures::both || rings > 0 || rest_distance > 0;
  }
};

// Each member by its name, in reports, certificates and messages.
ASSAY_FIELDS(Contract, adjacency, coordinates, margin, start, start_distance, least_nonzero,
             largest, features, time_tolerance, reports_pairs, separation, counts, rings,
             rest_distance, takes_relations, limit_gives, progress, motion, capacity_triangles,
             capacity_contacts, capacity_candidates)

// The shortest decimal that reads back to the same double. It is made without libfmt, because the
// worker does not use that.
std::string number_text(double x);

// What is wrong with the contract, without a subject ("its margin is no length"); empty if nothing
// is.
std::string fault_of(const Contract& contract);

// What the contract leaves out or changes, one phrase each: "starts free", "edges from 1e-06",
// "coordinates up to 1e+06", "times within 1e-09". Empty for the contract that leaves nothing out.
std::vector<std::string> phrases_of(const Contract& contract);

// How much a step is, as the oracle counts it: triangles of its mesh, pairs of them in contact that
// the contract does not leave out, and feature pairs whose swept boxes meet.
struct StepLoad {
  std::uint64_t triangles = 0, contacts = 0, candidates = 0;
};
// Whether a detector with this contract may refuse such a step.
bool beyond_capacity(const Contract& contract, const StepLoad& load);

// The relation of what the contract tests, on a mesh whose vertices are at rest at `rest`.
detector::CountedPairs tested_pairs(const Contract& contract, const detector::Positions& rest);

int shared_vertices(const detector::TrianglesView& triangles, detector::TrianglePair pair);

// Whether the contract's adjacency alone lets the detector leave this pair out.
bool leaves_out(const Contract& contract, const detector::TrianglesView& triangles,
                detector::TrianglePair pair);

// The positions that the detector and the oracle are both given. A coordinate that has no float32
// becomes infinite.
detector::Positions contracted(const detector::PositionsView& x, Coordinates coordinates);

// The displacement of a step that a detector of float32 is given: the nearest to its way.
detector::Positions displacement(const detector::PositionsView& x_t0,
                                 const detector::PositionsView& x_t1);

using Edge = std::array<std::int32_t, 2>;

double length_of(const detector::PositionsView& x, const Edge& edge);

// Where a mesh with these edges leaves the contract's range, with the member of the contract:
// "vertex 3 has the coordinate 2e+06, above largest, 1e+06" or "edge 3-4 is 2e-13 long, below
// least_nonzero, 1e-06". Empty if it does not.
std::string beyond_range(const detector::PositionsView& x, const std::vector<Edge>& edges,
                         const Contract& contract);

// What a detector claims of its answers.

// In the list below t* is the first contact time of the step; under a contract with a separation d
// it is the first time within d, and a contact is a pair that comes within d. The contact graph at
// t* has the triangles as nodes, and the pairs that are in contact at t* as edges.
enum class Claim : std::uint8_t {
  free_sound,     // never `free` when the oracle has a contact
  not_late,       // lower end of its first time <= t*
  first_time,     // the interval of its first time holds t*
  first_pairs,    // every connected part of the contact graph at t* holds a reported pair
  all_pairs,      // every pair of the oracle is reported, none with a time after its own
  no_spurious,    // reports no contact that is not there, and none too early
  deterministic,  // the same input gives the same result
  total,          // every valid input within the limits is answered
  candidates,     // every pair of the oracle is among the candidate pairs of its broad phase
  // Of a limiter (L17), in steps that start without a contact.
  commit_free,  // the step to the positions that it allows has no contact
  path_free,    // the share that it allows is below t*
  progress,     // that share is Contract::progress of what is possible or more (judge_limit)
  whole,        // it allows a step without a contact to its very end
  // Every time is the enclosure of exact arithmetic, so it has to be the oracle's in every bit.
  // This is how the other claims on times are read of a detector that claims it. Only the built-in
  // detector does: nobody claims it from outside, and no list names it.
  times_unique,
};
constexpr auto names_of(Claim) {
  using enum Claim;
  return std::to_array<Named<Claim>>({{free_sound, "free-sound"},
                                      {not_late, "not-late"},
                                      {first_time, "first-time"},
                                      {first_pairs, "first-pairs"},
                                      {all_pairs, "all-pairs"},
                                      {no_spurious, "no-spurious"},
                                      {deterministic, "deterministic"},
                                      {total, "total"},
                                      {candidates, "candidates"},
                                      {commit_free, "commit-free"},
                                      {path_free, "path-free"},
                                      {progress, "progress"},
                                      {whole, "whole-when-safe"},
                                      {times_unique, "times-unique"}});
}

// A set of claims.
class Claims {
 public:
  constexpr Claims() = default;
  constexpr Claims(std::initializer_list<Claim> claims) {
    for (const Claim claim : claims) bits_ |= bit_of(claim);
  }
  static constexpr Claims of_bits(std::uint32_t bits) {
    Claims claims;
    claims.bits_ = bits;
    return claims;
  }

  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool has(Claim claim) const { return (bits_ & bit_of(claim)) != 0; }
  constexpr bool has_any(const Claims& others) const { return (bits_ & others.bits_) != 0; }
  constexpr Claims& set(Claim claim, bool is_claimed = true) {
    bits_ = is_claimed ? bits_ | bit_of(claim) : bits_ & ~bit_of(claim);
    return *this;
  }
  // Those of them that are also among the others, and those that are not.
  constexpr Claims only(const Claims& others) const { return of_bits(bits_ & others.bits_); }
  constexpr Claims without(const Claims& others) const { return of_bits(bits_ & ~others.bits_); }
  constexpr Claims with(const Claims& others) const { return of_bits(bits_ | others.bits_); }

  friend constexpr bool operator==(const Claims&, const Claims&) = default;

 private:
  static constexpr std::uint32_t bit_of(Claim claim) { return 1u << static_cast<unsigned>(claim); }
  std::uint32_t bits_ = 0;
};

// Those that only a limiter can make.
inline constexpr Claims claims_on_limits = {Claim::commit_free, Claim::path_free, Claim::progress,
                                            Claim::whole};

// Those that a detector may claim from outside. Their numbers are the bits of
// assay_description::claims (detector/plugin/assay_detector.h).
inline constexpr Claims claims_from_outside =
    Claims::of_bits((1u << static_cast<unsigned>(Claim::times_unique)) - 1);

// Those of claims_from_outside that `claims` has, in the order of Claim; and all of them.
std::vector<Claim> list_of(const Claims& claims);
std::vector<Claim> all_claims();

// What the built-in detector claims. exact: everything. bounded: everything but no-spurious (its
// intervals hold the times by construction, see StepResult::first). double and float:
// deterministic and total. With pairs first, no arithmetic claims all-pairs.
Claims claims_of(const detector::Options& options);

// The progress that the built-in detector promises where it limits a step.
inline constexpr double built_in_progress = 0.9;

// What the built-in detector is asked with these options: contact, or within a separation of pairs
// that share no vertex.
Contract contract_of(const detector::Options& options);

// The claims that are judged under this contract. If it has a margin, first-time is not judged,
// because the detector may then report a collision before there is one; no-spurious is judged with
// the margin of queries, and of steps if the detector leaves neighbours out. First-pairs and
// all-pairs are not judged of a detector that reports no pairs.
Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries = false);

// What a plug-in says of itself.

// What a library can do. The defaults are those of the built-in detector, which answers steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool limit = false;
  bool takes_threads = false;  // it has a function by which it is told how many threads it may use
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// What keeps a text from being the name of a detector, or its version: it is longer than 100 bytes,
// begins or ends with a space, or is the name of the built-in detector. Empty if nothing does.
std::string fault_of_name(std::string_view name);

// What is wrong with what it says of a limiter: claims without one, one without claims, or a claim
// on progress without Contract::progress. Empty if nothing is.
std::string fault_of_limits(const Claims& claims, const Contract& contract, bool has_limit);

// Those of its claims that can be judged by playing steps. These are all that it makes, or, for a
// library that answers no steps, those of candidates, limits, deterministic and total.
Claims claims_on_steps(const PluginDescription& description);
// Those of its claims that can be judged by asking its query: all that it makes except those about
// pairs, candidates and limits.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
