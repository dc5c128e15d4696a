// The rungs of a query, the cheapest first. Each rung either decides a query with certainty or
// passes it on to the next rung. The last function of this file is no rung: tests compare the last
// rung with it.
#pragma once

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// The rung "axis", the first rung of the oracle's elementary test. It only compares differences of
// inputs, so it is exact for every finite input. Takes about 0.03 us.

// Returns true if, along some axis, one group of points (of the vertex and the face, or of the two
// edges) lies more than `distance` before the other group at t=0 and at t=1.
// Then it does so at every time, because each difference of two coordinates is linear in time. So
// the two groups never come within `distance`.
bool separated_by_axis(const FourPoints& q, double distance = 0);

// The rung "interval" finds signs in interval arithmetic on pieces of the step, each piece
// computed from the original coordinates. 1 to 2 us a query. It never guesses: if it cannot prove
// an answer, its decision is `open`.

struct IntervalAnswer {
  detector::Decision decision = detector::Decision::open;
  // Set if there is a contact and the caller wants Want::first_time. Then the first contact time is
  // the only zero of F in [s,e]. That zero lies in (s,e) and is simple, and F has strictly opposite
  // signs at s and e.
  double s = 0, e = 1;
};

// Judges a query piece by piece. A piece of the step is free of contact if on the piece the groups
// stay ordered along an axis, or F has one strict sign, or some axis has one L that is surely > 0
// and one L that is surely < 0. A piece holds a contact if F surely changes its sign between the
// bounds of the piece and all four L of some axis surely have one sign. The earliest piece is
// judged first, and a contact with its time is claimed only if all earlier pieces are free of
// contact. A query with a coordinate of 2^300 or more is passed on to the next rung, so no interval
// ever overflows.
IntervalAnswer interval_answer(const FourPoints& q, detector::Want want);

// The rung "quadratic": the complete exact test, by closed formulas. About 8 us for contacts on the
// border of a feature and for points that stay in one plane, 10 us for other cubics; 25 to 100 us
// if the coordinates spread over 2^+-100 to 2^+-300, 0.4 ms if they spread over all doubles.

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query. It needs only signs at zeros of quadratics (times/times.h), and finds each
// sign from the signs of a few integers.
ExactAnswer quadratic_answer(ContactPolynomials& polynomials, detector::Want want);

// Finds the answer of quadratic_answer by other means: CGAL's algebraic kernel. algebraic_answer is
// no rung; tests compare the last rung with it. Takes 0.1 to 0.4 ms; if the exponents of the
// coordinates spread over all doubles, 7 ms on average and up to 0.1 s.

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query.
ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
