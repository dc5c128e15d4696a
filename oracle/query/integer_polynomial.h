// Polynomials in time with integer coefficients of any size, their divisors, and the conversion of
// a query's doubles into integers.
#pragma once

#include <gmpxx.h>

#include <array>
#include <span>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::oracle {

using Integer = mpz_class;

// c[0] + c[1] t + ... The last coefficient is never 0; the zero polynomial has no coefficients.
struct IntegerPolynomial {
  std::vector<Integer> c;

  bool is_zero() const { return c.empty(); }
  int degree() const { return static_cast<int>(c.size()) - 1; }
};

IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b);
IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b);
IntegerPolynomial operator-(const IntegerPolynomial& a);
IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b);

// Returns the linear polynomial with these values at t=0 and t=1.
IntegerPolynomial linear(const Integer& at_t0, const Integer& at_t1);

IntegerPolynomial derivative(const IntegerPolynomial& p);

// Returns the discriminant: zero exactly when p has a root of multiplicity 2 or more. REQUIRES a
// degree of at most 3.
Integer discriminant(const IntegerPolynomial& p);

// Returns the exact sign of p at t. REQUIRES t finite and >= 0.
int sign_at(const IntegerPolynomial& p, double t);

// Returns the scaled Bernstein coefficients of p over [0,1] (interval_sign.h): the first and the
// last are p(0) and p(1). Empty for the zero polynomial.
std::vector<Integer> bernstein_over_unit(const IntegerPolynomial& p);

// Returns how often the sign changes in a sequence; elements that are 0 are skipped. If the
// elements are the Bernstein coefficients of p, the result 0 says that p has no zero in the open
// interval, and 1 says that p has exactly one zero there (Descartes' rule).
int sign_changes(const std::vector<Integer>& sequence);

// Returns true if Descartes' rule in Bernstein form shows that p has no zero in [0,1]. False says
// nothing.
bool surely_no_zero_in_unit(const IntegerPolynomial& p);

// Returns the greatest common divisor, scaled so that no integer above 1 divides all of its
// coefficients; 1 if p and q have no common zero. REQUIRES that neither polynomial is zero. Takes a
// few us if the result is 1; else 10 us to 10 ms for coefficients of 300 to 12,000 bits.
IntegerPolynomial common_divisor(const IntegerPolynomial& p, const IntegerPolynomial& q);

// Returns p divided by a divisor of p, such as a common_divisor. REQUIRES that no integer above 1
// divides all coefficients of the divisor.
IntegerPolynomial quotient(const IntegerPolynomial& p, const IntegerPolynomial& divisor);

// Returns p(lo + (hi - lo) x) as a polynomial of x, up to a positive factor. REQUIRES lo and hi in
// [0,1]; hi may be less than lo.
IntegerPolynomial on_piece(const IntegerPolynomial& p, double lo, double hi);

// Turns the doubles of a query into integers: it multiplies them by the least power of two that
// makes every coordinate of the points an integer. This changes neither a contact time nor the sign
// of a homogeneous polynomial of the coordinates.
class IntegerScale {
 public:
  explicit IntegerScale(std::span<const detector::MovingPoint> points);

  // Returns the integer of a coordinate. REQUIRES a coordinate of the constructor's points.
  Integer operator()(double coordinate) const;
  // Returns the exponent: a coordinate is its integer times 2^exponent().
  int exponent() const { return exponent_; }

 private:
  int exponent_ = 0;  // every coordinate is a multiple of 2^exponent_
};

// A vector whose coordinates are polynomials in time.
using PolynomialVector = std::array<IntegerPolynomial, 3>;

// Returns `to - from`, scaled: three linear polynomials.
PolynomialVector moving_difference(const IntegerScale& scale, const detector::MovingPoint& from,
                                   const detector::MovingPoint& to);

// Vector operations for coordinates that are integers, rationals, polynomials, intervals or
// doubles.
template <class Number>
std::array<Number, 3> operator-(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}
template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
          Number(a[0] * b[1] - a[1] * b[0])};
}
template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace assay::oracle
