// Whether features of a mesh at rest are nearer to each other than a given distance.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

// Says whether a pair of triangles, the lower index first, is to be looked at.
using WantedPair = std::function<bool(std::int32_t, std::int32_t)>;

// A pair of triangles that `counts` accepts and that is in contact at rest (instant_contacts.h
// says what that is), or holds a vertex and a face, or two edges, that share no vertex and are
// nearer to each other than `distance`; nothing if there is none. The comparison is exact, of
// squared distances in rationals. With distance 0 the question is whether there is a contact.
// REQUIRES indices in range, finite positions, distance finite and not negative. 5 to 20 us for
// each pair of features whose boxes are that near; stops at the first that it finds.
std::optional<detector::TrianglePair> any_nearer_than(const detector::PositionsView& x,
                                                      const detector::TrianglesView& triangles,
                                                      double distance, const WantedPair& counts);

// Whether two features, each given by its vertices, are nearer to each other than `distance` at
// these places, compared exactly. A vertex and a face that holds it have distance 0.
// REQUIRES distance finite and greater than 0.
bool vertex_nearer_than(const std::vector<detector::Point>& places, std::int32_t vertex,
                        const Face& face, double distance);
bool edges_nearer_than(const std::vector<detector::Point>& places, const Edge& a, const Edge& b,
                       double distance);
// The same of two whole faces, which are at distance 0 if they share a vertex or pierce each other.
bool faces_nearer_than(const std::vector<detector::Point>& places, const Face& a, const Face& b,
                       double distance);

}  // namespace assay::oracle
