// Measures the highest memory that a detector takes for a mesh.
#pragma once

#include <optional>

#include "reports/bench/peers/peer_subject.h"

namespace assay::reports {

// Bytes for each triangle of a mesh of 20,480 triangles, for preprocessing and one step: how far
// the resident memory of a new process rises above that with a mesh of 20 triangles. Nothing if a
// run does not complete.
std::optional<double> bytes_a_triangle(const PeerSubject& subject);

}  // namespace assay::reports
