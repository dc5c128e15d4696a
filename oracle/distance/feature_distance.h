// When two moving features first come within a distance of each other, and how near they come.
//
// Guarantee: as in query/contact.h, the answer is that of exact arithmetic on the doubles given,
// for every finite input, degenerate features and features at rest included. Within d means a
// distance of d or less, t=0 and t=1 count, and the square of d is exact. With d = 0 this is a
// contact. Cost: 0.03 us if an axis tells, 0.3 to 0.6 us for nearly all other pairs that stay apart
// or begin near; a first time later than 0 takes 50 to 100 us, a touch at exactly d some 0.3 ms. If
// exponents spread over all doubles, 10 ms in the mean and up to 0.1 s. Thread safe. Ends the
// process when the processor does not round to nearest or flushes denormals.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/distance/regions.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

struct FirstNear {
  bool near = false;
  // The first time within d; set only when near is true and a time was wanted.
  detector::TimeEnclosure first;
  // The rung that decided: axis, interval, or integers (regions.h), which count as quadratic. The
  // time of what interval found near is then computed in integers.
  Rung rung = Rung::axis;
};

// The features of a query are its two groups: a vertex and a face, or two edges, as in contact.h.
FirstNear first_time_within(const detector::FourPoints& q, const Separation& d,
                            detector::Want want = detector::Want::first_time);

// The least double d that the features come within during the step. The least distance is at most d
// and greater than the double before d; it is 0 where d is 0. Infinity where no double is so large.
// 1 ms; 25 ms where it is next to 0 but not 0.
double least_distance(const detector::FourPoints& q);

}  // namespace assay::oracle
