// The rung "quadratic": the complete exact test where every time at which a contact can begin is a
// zero of a polynomial of degree 1 or 2. Signs at such times are closed formulas
// (quadratic_time.h), so this is 20 times faster than the algebraic rung: about 10 us.
#pragma once

#include <optional>

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// Tests the contact condition at each time at which a contact can begin (contact_events.h).
// Decided are queries
// - that are coplanar throughout, because L and D have degree <= 2;
// - whose F has degree <= 2, as where two or more points share their motion;
// - whose cubic F has no zero in the step, or is seen to be a product: a zero at t=0 or t=1, a
//   double zero, or a factor in common with one of the L.
// The last holds of every contact on the border of a feature, in which other rungs are least
// certain: there some dependency has a zero weight, so some L of each axis is zero together with
// F, and not all of these are identically zero unless F is.
// Nothing is returned for other queries.
std::optional<ExactAnswer> quadratic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
