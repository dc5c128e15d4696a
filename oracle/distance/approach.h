// The fast rungs of a question about distance: they say at which times two features are surely
// farther apart than d, or surely not, and leave the rest to integers.
#pragma once

#include "oracle/distance/regions.h"

namespace assay::oracle {

// The rung "axis", exact: along some axis the features are more than d apart at both ends of the
// step, in the same order, and so at all times. Comparisons of rounded differences: 0.03 us.
bool apart_by_axis(const detector::FourPoints& q, const Separation& d);

// What the rung "interval" proved.
struct Approach {
  // no: farther apart than d at all times. yes: within d at `near`. open: neither is known.
  detector::Decision decision = detector::Decision::open;
  // Farther apart than d on [0,apart]; negative if not even that is known.
  double apart = -1;
  double near = 1;
};

// Walks along the step from time 0. At each time it takes the direction in which the features are
// apart, as found in plain doubles, and asks for how long they stay apart in that direction. That
// is linear in time, so two values decide, in interval arithmetic; the walk goes on from there. At
// the first time it nears d as Newton's method does. Two places of the features that are surely
// within d prove the rest. Coordinates or distances of 2^250 or more are left to the next rung. 0.3
// to 0.6 us for most pairs.
Approach approach(const detector::FourPoints& q, const Separation& d);

// The least distance over the step in plain doubles: a guess.
double guess_least_distance(const detector::FourPoints& q);

}  // namespace assay::oracle
