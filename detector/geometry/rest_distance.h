// Whether features of a mesh at rest are nearer to each other than a distance: the part of the
// relation between pairs (mesh/counted_pairs.h) that takes arithmetic. Exact for all finite inputs.
#pragma once

#include <array>

#include "detector/mesh/types.h"

namespace assay::detector {

// The least distance of two sets is that of two closed faces of theirs (a point, an edge, the whole
// feature) whose perpendicular has its feet inside both. So it is less than r if and only if this
// holds for some pair of closed faces. With the feet as conditions on the signs of products, and
// the distance squared, no number is divided:
//   points p, a           |p-a|^2 < r^2
//   point p, edge ab      |w x e|^2 < r^2 |e|^2, if 0 <= w.e <= |e|^2 and |e|^2 > 0
//   point p, face abc     ((p-a).N)^2 < r^2 |N|^2, if p is over the face and |N|^2 > 0
//   edges ab, ce          (w.N)^2 < r^2 |N|^2, if both feet lie inside and |N|^2 > 0
// with e = b-a and w = p-a, or N the product of the two edges and w = c-a. A feature that has
// collapsed is left to its own faces. All of it is computed in integers (exact/integer.h).
//
// REQUIRES r finite. 2 to 10 us each, unless the boxes of the two tell: then 10 ns.
bool vertex_is_nearer_to_face(const Point& p, const std::array<Point, 3>& face, double r);
bool edges_are_nearer(const std::array<Point, 2>& a, const std::array<Point, 2>& b, double r);

// The same of two triangles that share no vertex, which pierce each other or of which two features
// are that near.
bool triangles_are_nearer(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double r);

}  // namespace assay::detector
