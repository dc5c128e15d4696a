// Tells whether features and faces at rest are nearer to each other than a distance. Compares
// exactly, in rational numbers: 5 to 20 us for two features whose boxes are nearer than the
// distance.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

// Returns whether two features, each given by its vertices, are nearer to each other than
// `distance` when each vertex is at its place in `places`. Exact. A vertex and a face that holds it
// have distance 0. REQUIRES distance finite and greater than 0.
bool vertex_nearer_than(const std::vector<detector::Point>& places, std::int32_t vertex,
                        const Face& face, double distance);
bool edges_nearer_than(const std::vector<detector::Point>& places, const Edge& a, const Edge& b,
                       double distance);
// Returns whether two whole faces are nearer to each other than `distance`. Faces that share a
// vertex or pierce each other have distance 0.
bool faces_nearer_than(const std::vector<detector::Point>& places, const Face& a, const Face& b,
                       double distance);

}  // namespace assay::oracle
