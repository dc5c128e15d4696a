// Whether features of a mesh at rest are nearer to each other than a distance: the part of the
// relation between pairs (mesh/counted_pairs.h) that takes arithmetic. Exact for all finite inputs.
#pragma once

#include <array>

#include "detector/mesh/types.h"

namespace assay::detector {

// Decided by the regions of near_regions.h, in integers (exact/integer.h).
//
// REQUIRES r finite. 2 to 10 us each, unless the boxes of the two tell: then 10 ns.
bool vertex_is_nearer_to_face(const Point& p, const std::array<Point, 3>& face, double r);
bool edges_are_nearer(const std::array<Point, 2>& a, const std::array<Point, 2>& b, double r);

// The same of two triangles that share no vertex, which pierce each other or of which two features
// are that near.
bool triangles_are_nearer(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double r);

}  // namespace assay::detector
