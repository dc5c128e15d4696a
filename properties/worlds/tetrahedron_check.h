// The check of one class of a tetrahedron's motions: detector and laws against the oracle.
#pragma once

#include <optional>
#include <string>

#include "properties/worlds/tetrahedron_world.h"

namespace assay::properties {

struct TetrahedronFailure {
  corpus::Case c;
  std::string explanation;
};

// Checks all view-points of the motion, in both orientations, and adds to the counts. Returns the
// first failure, or nothing.
std::optional<TetrahedronFailure> check_tetrahedron(const TetrahedronMotion& motion,
                                                    TetrahedronWorldResult& counts);

}  // namespace assay::properties
