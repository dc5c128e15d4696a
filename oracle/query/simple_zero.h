// The time of a zero that is known to be alone on its piece, without the algebraic kernel.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// f has exactly one zero in (s,e), a simple one, and opposite signs at s and e; 0 <= s < e <= 1.
// Exact integer signs of f at doubles enclose it. 1 to 3 us.
detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e);

}  // namespace assay::oracle
