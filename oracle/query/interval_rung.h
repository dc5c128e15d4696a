// The rung "interval" finds signs in interval arithmetic on pieces of the step, each piece
// computed from the original coordinates. 1 to 2 us a query. It never guesses: what it cannot
// prove is unknown.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/query/four_points.h"

namespace assay::oracle {

struct IntervalAnswer {
  detector::Decision decision = detector::Decision::open;
  // Set for a contact when Want::first_time was asked for: [s,e] holds exactly one zero of F,
  // which lies inside, is simple, and is the first contact time; F has strictly opposite signs at
  // s and e.
  double s = 0, e = 1;
};

// A piece of the step is free of contact when on it the groups stay ordered along an axis, or F
// keeps one sign, or some axis has one L surely > 0 and one surely < 0. It holds a contact when F
// surely changes sign over it and some axis has all four L surely of one sign. Pieces are taken in
// time order, and a contact with its time is claimed only when all earlier pieces are free.
// Coordinates of 2^300 or more are left to the next rung, so no interval ever overflows.
IntervalAnswer interval_answer(const FourPoints& q, detector::Want want);

}  // namespace assay::oracle
