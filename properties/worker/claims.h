// What a detector claims, and the contract under which it claims it: it is judged by these alone.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"
#include "detector/options.h"

namespace assay::properties {

// t* is the first contact time of the step. The contact graph at t* has the triangles as nodes, and
// as edges the pairs that are in contact then.
enum class Claim : std::uint8_t {
  free_sound,     // never `free` when the oracle has a contact
  not_late,       // lower end of its first time <= t*
  first_time,     // the interval of its first time holds t*
  first_pairs,    // every connected part of the contact graph at t* holds a reported pair
  all_pairs,      // every pair of the oracle is reported, none with a time after its own
  no_spurious,    // no collision, pair or time of a pair before there is one
  deterministic,  // the same input gives the same result
  total,          // every valid input within the limits is answered
};

struct Claims {
  bool free_sound = false, not_late = false, first_time = false, first_pairs = false,
       all_pairs = false, no_spurious = false, deterministic = false, total = false;
  bool has(Claim claim) const;
  friend bool operator==(const Claims&, const Claims&) = default;
};

// Which neighbours a detector tests against each other.
enum class Adjacency : std::uint8_t {
  all,               // every pair of triangles
  not_edge_sharing,  // pairs that share at most one vertex
  no_shared_vertex,  // pairs that share nothing
};

// Inputs of a float32 detector are rounded to the nearest float32 before it, and the oracle, see
// them.
enum class Coordinates : std::uint8_t { float64, float32 };

struct Contract {
  Adjacency adjacency = Adjacency::all;
  Coordinates coordinates = Coordinates::float64;
  double margin = 0;  // user's units; above 0 no_spurious is not judged
  friend bool operator==(const Contract&, const Contract&) = default;
};

// The words of reports and certificates: "free-sound", "not-edge-sharing", "float32".
const char* name_of(Claim claim);
const char* name_of(Adjacency adjacency);
const char* name_of(Coordinates coordinates);

// In the order of Claim.
const std::vector<Claim>& all_claims();
// Those that `claims` has, in that order.
std::vector<Claim> list_of(const Claims& claims);

// Of the built-in detector. exact: everything; bounded: everything but no-spurious (its intervals
// hold the times by construction, see StepResult::first); double and float: deterministic and
// total. With pairs first nobody claims all-pairs.
Claims claims_of(const detector::Options& options);

// The claims that are judged under this contract: with a margin, a collision before there is one is
// nobody's fault.
std::vector<Claim> judged_claims(const Claims& claims, const Contract& contract);

int shared_vertices(const detector::TrianglesView& triangles, detector::TrianglePair pair);

// Whether the contract lets the detector leave this pair out.
bool leaves_out(const Contract& contract, const detector::TrianglesView& triangles,
                detector::TrianglePair pair);

// The positions that detector and oracle are both given; infinite where a coordinate has no
// float32.
detector::Positions contracted(const detector::PositionsView& x, Coordinates coordinates);

}  // namespace assay::properties
