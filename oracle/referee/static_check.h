// A third opinion: do two triangles, at one time of the step, meet beyond what they share?
//
// By CGAL's do_intersect on exact rational positions. It knows nothing of motion, features or
// polynomials, so it checks pair sets: a pair that meets at a time of [0,1] must be in the pair
// set, with a first time not later than that.
#pragma once

#include <variant>

#include "detector/mesh/step_types.h"
#include "oracle/rational_time.h"

namespace assay::oracle {

// A time in [0,1]: a fraction, or a double taken as exact.
using StaticTime = std::variant<RationalTime, double>;

// -1, 0 or 1 as time is less than, equal to or greater than t. Exact. t is finite.
int compare(const StaticTime& time, double t);

// Whether some closed face (vertex, edge or triangle) of triangle a meets one of triangle b that
// shares no vertex index with it. Without common vertices the two triangles themselves; with one,
// each edge opposite it against the other triangle; with two, each third vertex against the other
// triangle and the crosswise edges against each other. A face that has become a segment or a point
// is that; a repeated index counts once.
// Two triangles with the same three vertices are in contact at t=0 by convention, which is no
// question of geometry: for them the answer is true at t=0, and geometry's later.
// REQUIRES a != b, indices in range, finite positions, a time in [0,1]. 1 us where boxes are apart
// at that time, else some 100 us.
bool triangles_meet(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1,
                    const detector::TrianglesView& triangles, detector::TrianglePair pair,
                    const StaticTime& time);

}  // namespace assay::oracle

// CGAL's own test of two triangles at rest, for a detector of corpus/peers that samples a step and
// is compiled with this file; the oracle asks nothing of it. Nine numbers each, corner by corner,
// finite. Exact on these doubles; touching counts; 0 where a triangle has no area.
extern "C" int assay_triangles_meet_now(const double* a, const double* b);
