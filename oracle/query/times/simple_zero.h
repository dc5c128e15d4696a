// Finds the time of a zero that is known to be alone on its piece, without the algebraic kernel.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// Encloses the zero of f in (s,e) by exact integer signs of f at doubles. REQUIRES that f is of
// degree 3 at most, that it has exactly one zero in (s,e), a simple one, and opposite signs at s
// and e, and that 0 <= s < e <= 1. 1 to 3 us.
detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e);

}  // namespace assay::oracle
