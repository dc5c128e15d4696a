// What is exactly true of the steps of a mesh.
#pragma once

#include "properties/vectors/vectors.h"

namespace assay::properties {

// The vector of a mesh with its facts, flags and hardness. Of a question about a limit: nothing
// unless it has one step, which starts without a contact.
std::optional<Vector> mesh_vector(corpus::Case c, VectorQuestion question,
                                  VectorPrecision precision);

}  // namespace assay::properties
