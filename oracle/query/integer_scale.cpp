#include "oracle/query/integer_scale.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace assay::oracle {

namespace {

struct Decomposed {
  double mantissa;  // an odd integer
  int exponent;     // the value is mantissa * 2^exponent
};

Decomposed decompose(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const double digits = std::ldexp(fraction, std::numeric_limits<double>::digits);
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(std::fabs(digits)));
  return {std::ldexp(digits, -zeros), exponent - std::numeric_limits<double>::digits + zeros};
}

}  // namespace

IntegerScale::IntegerScale(std::span<const detector::MovingPoint> points) {
  int least = std::numeric_limits<int>::max();
  auto include = [&](const detector::Point& p) {
    for (double x : p) {
      assert(std::isfinite(x));
      if (x != 0) least = std::min(least, decompose(x).exponent);
    }
  };
  for (const detector::MovingPoint& p : points) {
    include(p.t0);
    include(p.t1);
  }
  if (least != std::numeric_limits<int>::max()) exponent_ = least;
}

Integer IntegerScale::operator()(double coordinate) const {
  if (coordinate == 0) return 0;
  const Decomposed d = decompose(coordinate);
  assert(d.exponent >= exponent_);
  return Integer(d.mantissa) << static_cast<mp_bitcnt_t>(d.exponent - exponent_);
}

PolynomialVector moving_difference(const IntegerScale& scale, const detector::MovingPoint& from,
                                   const detector::MovingPoint& to) {
  PolynomialVector u;
  for (int k = 0; k < 3; ++k) {
    u[k] = linear(scale(to.t0[k]) - scale(from.t0[k]), scale(to.t1[k]) - scale(from.t1[k]));
  }
  return u;
}

PolynomialVector cross(const PolynomialVector& u, const PolynomialVector& v) {
  PolynomialVector w;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    w[k] = u[i] * v[j] - u[j] * v[i];
  }
  return w;
}

IntegerPolynomial dot(const PolynomialVector& u, const PolynomialVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

}  // namespace assay::oracle
