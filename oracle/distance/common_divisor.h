// Divisors of integer polynomials, and a polynomial on a piece of the step.
#pragma once

#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// The greatest common divisor, with coefficients without a common divisor; 1 if the two have no
// zero in common. REQUIRES neither to be zero. A few us if it is 1; else 10 us to 10 ms for
// coefficients of 300 to 12,000 bits.
IntegerPolynomial common_divisor(const IntegerPolynomial& p, const IntegerPolynomial& q);

// p divided by a divisor of it, such as a greatest one above. REQUIRES that the coefficients of the
// divisor have no common divisor.
IntegerPolynomial quotient(const IntegerPolynomial& p, const IntegerPolynomial& divisor);

// p(lo + (hi - lo) x) as a polynomial of x, up to a positive factor. REQUIRES lo and hi in [0,1];
// hi may be the lesser.
IntegerPolynomial on_piece(const IntegerPolynomial& p, double lo, double hi);

}  // namespace assay::oracle
