// Where two features are nearest to each other at one instant, in plain doubles.
//
// This is a good guess, and no decision rests on it: near_filter.h proves what it takes from here.
#pragma once

#include "detector/exact/bernstein.h"

namespace assay::detector {

// The four points of a query at one instant, as they are seen from the first point.
using SeenPoints = std::array<Vector, 3>;  // of points 1, 2, 3

// Of the two features the vector from a place of the second one to a place of the first one, which
// are about nearest to each other. Each place is in its feature, up to the error of near_filter.h,
// also if the feature is only a segment or a point. 20 ns.
Vector between_nearest(const SeenPoints& x, int first_group);

}  // namespace assay::detector
