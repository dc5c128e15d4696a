// A list of the methods that answer an elementary query of contact, and some of distance. They must
// all agree.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "detector/mesh/step_types.h"
#include "oracle/query/contact.h"
#include "properties/claims/claims.h"

namespace assay::properties {

// A query in the order of both rooms: vertex-face {0}|{1,2,3}, edge-edge {0,1}|{2,3}.
using Query = detector::FourPoints;

struct MethodAnswer {
  detector::Decision decision = detector::Decision::open;  // open: the method cannot tell
  std::optional<detector::TimeEnclosure> first;            // set if the method answers with a time
  int rung = 0;                                            // which of the method's rungs decided
};

struct QueryMethod {
  const char* name;
  MethodAnswer (*answer)(const Query& query);
  std::array<const char*, 5> rungs = {"", "", "", "", ""};  // their names; "" for none
  // Of free-sound and no-spurious. Bounded arithmetic may raise false alarms; plain doubles and
  // floats promise nothing.
  Claims claims = {Claim::free_sound, Claim::no_spurious};
  bool is_referee = false;
  // Whether the features come within d, finite and >= 0; null if the method knows no distance.
  MethodAnswer (*within)(const Query& query, double d) = nullptr;
};

// All methods but the oracle's timed answer, with which they are compared: the oracle asked for
// yes or no, CGAL's algebraic kernel without the oracle's rungs, the detector's ladder (yes or no,
// and timed), the detector's integers alone, and the second referee, which has no times and leaves
// touches open.
std::span<const QueryMethod> query_methods();

// Those that a user may ask by name, each for yes or no: the oracle, its referee with all the work
// that it may do, and the detector's ladder in each arithmetic.
std::span<const QueryMethod> named_methods();
const QueryMethod& oracle_method();
const QueryMethod& detector_method();  // in exact arithmetic

}  // namespace assay::properties
