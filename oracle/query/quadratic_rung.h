// The rung "quadratic": the complete exact test, by closed formulas. About 8 us for contacts on the
// border of a feature and for points that stay in one plane, 10 us for other cubics; 25 to 100 us
// if the exponents of the coordinates spread over 2^+-100 to 2^+-300, 0.4 ms if over all doubles.
#pragma once

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query. All signs in question are found as signs at zeros of quadratics
// (times/quadratic_time.h, times/cubic_times.h), and these are signs of a few integers.
ExactAnswer quadratic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
