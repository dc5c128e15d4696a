// Tells by a third method whether two triangles, at one time of the step, meet beyond the vertices
// and edges that they share.
//
// CGAL's do_intersect answers on exact rational positions. It knows nothing of motion, features or
// polynomials, so it can check pair sets: a pair that meets at a time of [0,1] must be in the pair
// set, and its first time must not be later than that time.
#pragma once

#include <variant>

#include "detector/mesh/step_types.h"
#include "oracle/rational_time.h"

namespace assay::oracle {

// A time in [0,1]: a fraction, or a double taken as exact.
using StaticTime = std::variant<RationalTime, double>;

// Returns -1, 0 or 1 if time is less than, equal to or greater than t. Exact. REQUIRES t finite.
int compare(const StaticTime& time, double t);

// Returns true if some closed face (vertex, edge or triangle) of triangle a meets a closed face of
// triangle b, and the two faces share no vertex index. If the triangles have no common vertex, they
// are tested against each other. If they have one, each edge opposite it is tested against the
// other triangle. If they have two, each third vertex is tested against the other triangle, and
// each edge of a with one common vertex is tested against the edge of b with the other common
// vertex. A face that has become a segment or a point is tested as a segment or a point. A repeated
// index counts once. Two triangles with the same three vertices are in contact at t=0 by
// convention, whatever their places: for them the answer at t=0 is true, and at later times
// geometry decides. REQUIRES a != b, indices in range, finite positions, a time in [0,1]. 1 us if
// the boxes are apart at that time, else some 100 us.
bool triangles_meet(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                    detector::TrianglePair pair, const StaticTime& time);

}  // namespace assay::oracle

// Returns 1 if two triangles at rest meet, and 0 if they do not or if a triangle has no area. The
// answer is that of CGAL's own test, and is exact for these doubles; touching triangles meet. A
// triangle is nine finite numbers, corner by corner. A detector of corpus/peers that samples a step
// is compiled with this file and calls this function; the oracle never calls it.
extern "C" int assay_triangles_meet_now(const double* a, const double* b);
