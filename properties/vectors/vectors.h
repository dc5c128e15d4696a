// The conformance set: small hard cases with exact answers, in files that others run without us
// (corpus/vectors/README.md says what the files hold).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/words.h"

namespace assay::properties {

// What an answer is held against. The exact answer to what is acceptable is `collision`: the
// features touch, and do not pass. Where touching is no contact by convention, `free` is right too.
enum class VectorResult : std::uint8_t { free, acceptable, collision };
constexpr auto names_of(VectorResult) {
  using enum VectorResult;
  return std::to_array<Named<VectorResult>>(
      {{free, "free"}, {acceptable, "acceptable"}, {collision, "collision"}});
}

// What is asked: is there a contact; do two features come within a distance; how far may the step
// be gone.
enum class VectorQuestion : std::uint8_t { contact, distance, limit };
constexpr auto names_of(VectorQuestion) {
  using enum VectorQuestion;
  return std::to_array<Named<VectorQuestion>>(
      {{contact, "contact"}, {distance, "distance"}, {limit, "limit"}});
}

enum class VectorFeatures : std::uint8_t { vertex_face, edge_edge, mesh };
constexpr auto names_of(VectorFeatures) {
  using enum VectorFeatures;
  return std::to_array<Named<VectorFeatures>>(
      {{vertex_face, "vertex-face"}, {edge_edge, "edge-edge"}, {mesh, "mesh"}});
}

enum class VectorPrecision : std::uint8_t { float64, float32 };
constexpr auto names_of(VectorPrecision) {
  using enum VectorPrecision;
  return std::to_array<Named<VectorPrecision>>({{float64, "double"}, {float32, "float32"}});
}

// Why a case is hard. Below, the cubic is F of oracle/query/contact_events.h. Of a mesh, what is
// said of two features is said of those that meet first.
enum class VectorFlag : std::uint8_t {
  double_root,
  coplanar_throughout,
  parallel_edges,
  touch_at_end,
  tangential,
  near_miss,
  at_start,
  at_end,
  at_rest,
  no_area,
  denormal,
  large_numbers,
  mixed_scales,
  far_from_origin,
  huge_step,
  at_distance,
  split_invariant,
  shared_vertex,
  through_hole,
  many_contacts,
  duplicate,
  sequence,
};
constexpr auto names_of(VectorFlag) {
  using enum VectorFlag;
  return std::to_array<Named<VectorFlag>>({{double_root, "DoubleRoot"},
                                           {coplanar_throughout, "CoplanarThroughout"},
                                           {parallel_edges, "ParallelEdges"},
                                           {touch_at_end, "TouchAtEnd"},
                                           {tangential, "Tangential"},
                                           {near_miss, "NearMiss"},
                                           {at_start, "AtStart"},
                                           {at_end, "AtEnd"},
                                           {at_rest, "AtRest"},
                                           {no_area, "NoArea"},
                                           {denormal, "Denormal"},
                                           {large_numbers, "LargeNumbers"},
                                           {mixed_scales, "MixedScales"},
                                           {far_from_origin, "FarFromOrigin"},
                                           {huge_step, "HugeStep"},
                                           {at_distance, "AtDistance"},
                                           {split_invariant, "SplitInvariant"},
                                           {shared_vertex, "SharedVertex"},
                                           {through_hole, "ThroughHole"},
                                           {many_contacts, "ManyContacts"},
                                           {duplicate, "Duplicate"},
                                           {sequence, "Sequence"}});
}

// What readers are told of a flag.
struct FlagText {
  VectorFlag flag;
  std::string_view when;   // of a case, behind "where": "two roots of the cubic coincide"
  std::string_view about;  // when a case has it, and why that is hard
  std::string_view wrong;  // what usually goes wrong
  std::vector<std::string_view> links;  // public reports; may be empty
};
std::span<const FlagText> flag_texts();  // one for each flag, in order

// The exact facts of one step, or of a query.
struct VectorFacts {
  VectorResult result = VectorResult::free;
  std::optional<detector::TimeEnclosure> first;  // unless free
  // Integers c0, c1, ... The first time is a zero of c0 + c1 t + ... between its ends. Unless free.
  std::vector<std::string> polynomial;
  // Of a mesh: all in contact, ascending. Absent: none, if free; else they are not stated.
  std::optional<std::vector<corpus::ExpectedPair>> pairs;
  std::optional<double> least_distance;  // of a question about distance (oracle/distance)
  friend bool operator==(const VectorFacts&, const VectorFacts&) = default;
};

// How near a case is to what makes it hard: 2^-bits, as a share (search/gap.h).
struct VectorHardness {
  std::string kind;
  int bits = 0;
  friend bool operator==(const VectorHardness&, const VectorHardness&) = default;
};

struct Vector {
  // The motion, without options and expected facts. A query is a case of query_case.h. `id` is that
  // of the vector, `about` its sentence, and `source` says how to make it again.
  corpus::Case c;
  VectorQuestion question = VectorQuestion::contact;
  double distance = 0;             // of a question about distance; else 0
  std::vector<VectorFacts> steps;  // one for each of corpus::steps_of(c); of a query one
  std::vector<VectorFlag> flags;   // ascending
  VectorHardness hard;
  std::vector<std::string> open;    // methods that stay open on it (methods.h)
  std::vector<std::string> breaks;  // public detectors that it was shrunk from
  std::string split_of;             // the id of the case of which it is a half; may be empty

  bool has(VectorFlag flag) const;
  VectorResult result() const;  // the greatest of the steps
};

struct VectorGroup {
  VectorFeatures features = VectorFeatures::vertex_face;
  VectorQuestion question = VectorQuestion::contact;
  VectorPrecision precision = VectorPrecision::float64;
  std::vector<Vector> cases;
  std::string name() const;  // "vertex-face-distance-float32", "steps-double"
};

struct VectorSet {
  std::string profile;
  std::vector<VectorGroup> groups;
  std::size_t size() const;  // how many cases
};

}  // namespace assay::properties
