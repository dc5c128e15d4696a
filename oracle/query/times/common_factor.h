// Takes polynomials with integer coefficients apart, by Euclid's algorithm.
#pragma once

#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// The greatest common divisor of a and b over the rationals, with integer coefficients that have
// no common factor. REQUIRES that neither is zero.
IntegerPolynomial common_factor(const IntegerPolynomial& a, const IntegerPolynomial& b);

// A positive or negative multiple of a / factor with integer coefficients. REQUIRES that the
// factor divides a over the rationals.
IntegerPolynomial cofactor(const IntegerPolynomial& a, const IntegerPolynomial& factor);

}  // namespace assay::oracle
