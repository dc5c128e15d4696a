// How much memory a detector takes for a mesh, at its highest.
#pragma once

#include <optional>

#include "reports/bench/peers/peer_subject.h"

namespace assay::reports {

// Bytes a triangle of a mesh of 20,480 triangles, for preprocessing and one step of it: how far the
// resident memory of a new process rises above that with a mesh of 20 triangles. Nothing where a
// run does not complete.
std::optional<double> bytes_a_triangle(const PeerSubject& subject);

}  // namespace assay::reports
