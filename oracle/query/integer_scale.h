// Turns the doubles of a query into integers, all by one power of two.
#pragma once

#include <span>

#include "detector/mesh/types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// Multiplies by the least power of two that makes every coordinate of the points an integer. The
// sign of any homogeneous polynomial of the coordinates stays as it is, and so does every contact
// time.
class IntegerScale {
 public:
  explicit IntegerScale(std::span<const detector::MovingPoint> points);

  // REQUIRES a coordinate of the given points.
  Integer operator()(double coordinate) const;
  // A coordinate is its integer times 2^exponent().
  int exponent() const { return exponent_; }

 private:
  int exponent_ = 0;  // every coordinate is a multiple of 2^exponent_
};

// A vector whose coordinates are polynomials in time.
using PolynomialVector = std::array<IntegerPolynomial, 3>;

// `to - from`, scaled: three linear polynomials.
PolynomialVector moving_difference(const IntegerScale& scale, const detector::MovingPoint& from,
                                   const detector::MovingPoint& to);

PolynomialVector cross(const PolynomialVector& u, const PolynomialVector& v);
IntegerPolynomial dot(const PolynomialVector& u, const PolynomialVector& v);

}  // namespace assay::oracle
