// The rungs of a query, from the cheapest on: each either is certain or passes the query on. Beside
// them stands the method that the last rung is compared with.
#pragma once

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// The first rung of the oracle's elementary test. It only compares differences of inputs, so it is
// exact for every finite input. About 0.03 us.

// Returns true when along some axis one group of points (the vertex and the face, or the two edges)
// lies more than `distance` before the other at t=0 and at t=1.
// It then does so at every time, because each difference of two coordinates is linear in time, so
// the two never come within that distance.
bool separated_by_axis(const FourPoints& q, double distance = 0);

// The rung "interval" finds signs in interval arithmetic on pieces of the step, each piece
// computed from the original coordinates. 1 to 2 us a query. It never guesses: an answer that it
// cannot prove is unknown.

struct IntervalAnswer {
  detector::Decision decision = detector::Decision::open;
  // Set for a contact when Want::first_time was asked for: [s,e] holds exactly one zero of F,
  // which lies inside, is simple, and is the first contact time; F has strictly opposite signs at
  // s and e.
  double s = 0, e = 1;
};

// Judges by pieces. A piece of the step is free of contact when on it the groups stay ordered along
// an axis, or F keeps one sign, or some axis has one L surely > 0 and one surely < 0. It holds a
// contact when F surely changes sign over it and some axis has all four L surely of one sign.
// Pieces are taken in time order, and a contact with its time is claimed only when all earlier
// pieces are free. Coordinates of 2^300 or more are left to the next rung, so no interval ever
// overflows.
IntervalAnswer interval_answer(const FourPoints& q, detector::Want want);

// The rung "quadratic": the complete exact test, by closed formulas. About 8 us for contacts on the
// border of a feature and for points that stay in one plane, 10 us for other cubics; 25 to 100 us
// if the exponents of the coordinates spread over 2^+-100 to 2^+-300, 0.4 ms if over all doubles.

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query. All signs in question are found as signs at zeros of quadratics
// (times/times.h), and these are signs of a few integers.
ExactAnswer quadratic_answer(ContactPolynomials& polynomials, detector::Want want);

// Finds the answer of quadratic_answer by other means: CGAL's algebraic kernel. It is no rung; the
// last rung is compared with it. 0.1 to 0.4 ms; if the exponents of the coordinates spread over all
// doubles, 7 ms on average and up to 0.1 s.

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query.
ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
