// A list of the methods that answer an elementary contact query. They must all agree.
#pragma once

#include <optional>
#include <span>

#include "detector/mesh/step_types.h"
#include "oracle/query/contact.h"

namespace assay::properties {

// A query in the order of both rooms: vertex-face {0}|{1,2,3}, edge-edge {0,1}|{2,3}.
using Query = detector::FourPoints;

struct MethodAnswer {
  detector::Decision decision = detector::Decision::open;  // open: the method cannot tell
  std::optional<detector::TimeEnclosure> first;            // set if the method answers with a time
};

struct QueryMethod {
  const char* name;
  MethodAnswer (*answer)(const Query& query);
};

// All methods but the oracle's timed answer, with which they are compared: the oracle asked for
// yes or no, CGAL's algebraic kernel without the oracle's rungs, the detector's ladder (yes or no,
// and timed), the detector's integers alone, and the second referee, which has no times and leaves
// touches open.
std::span<const QueryMethod> query_methods();

oracle::ContactAnswer ask_oracle(const Query& query, detector::Want want);

}  // namespace assay::properties
