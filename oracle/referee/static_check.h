// A third opinion: do two triangles, at one time of the step, meet beyond what they share?
//
// CGAL's do_intersect answers on exact rational positions. It knows nothing of motion, features or
// polynomials, so it can check pair sets: a pair that meets at a time of [0,1] must be in the pair
// set, with a first time not later than that.
#pragma once

#include <variant>

#include "detector/mesh/step_types.h"
#include "oracle/rational_time.h"

namespace assay::oracle {

// A time in [0,1]: a fraction, or a double taken as exact.
using StaticTime = std::variant<RationalTime, double>;

// Returns -1, 0 or 1 if time is less than, equal to or greater than t. Exact. REQUIRES t finite.
int compare(const StaticTime& time, double t);

// Returns true when some closed face (vertex, edge or triangle) of triangle a meets one of triangle
// b that shares no vertex index with it. If the two have no common vertex, they are tested
// themselves; with one, each edge opposite it is tested against the other triangle; with two, each
// third vertex against the other triangle and the crosswise edges against each other. A face that
// has become a segment or a point is tested as that; a repeated index counts once.
// Two triangles with the same three vertices are in contact at t=0 by convention, whatever their
// places: for them the answer at t=0 is true, and at later times geometry decides.
// REQUIRES a != b, indices in range, finite positions, a time in [0,1]. 1 us if the boxes are
// apart at that time, else some 100 us.
bool triangles_meet(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                    detector::TrianglePair pair, const StaticTime& time);

}  // namespace assay::oracle

// Asks CGAL's own test of two triangles at rest. It serves a detector of corpus/peers that samples
// a step and is compiled with this file; the oracle never asks it. A triangle is nine finite
// numbers, corner by corner. Returns 1 when the two meet, exactly for these doubles; touching
// counts. Returns 0 when they do not, or when a triangle has no area.
extern "C" int assay_triangles_meet_now(const double* a, const double* b);
