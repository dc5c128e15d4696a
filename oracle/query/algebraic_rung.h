// The rung "algebraic": the complete exact test by CGAL's algebraic kernel. 0.1 to 0.4 ms; if the
// exponents of the coordinates spread over all doubles, 7 ms on average and up to 0.1 s.
#pragma once

#include "oracle/query/contact_events.h"

namespace assay::oracle {

// Tests the contact condition at each time at which a contact can begin (contact_events.h). It
// decides every query.
ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

}  // namespace assay::oracle
