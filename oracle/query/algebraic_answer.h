// The answer of quadratic_answer by other means: CGAL's algebraic kernel. No rung, but what that
// rung is compared with. 0.1 to 0.4 ms; if the exponents of the coordinates spread over all
// doubles, 7 ms on average and up to 0.1 s.
#pragma once

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query.
ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
