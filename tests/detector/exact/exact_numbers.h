// Doubles as exact binary fractions, and numbers to compute with: for tests of error bounds.
#pragma once

#include <cmath>
#include <random>

#include "detector/exact/bernstein.h"
#include "detector/exact/polynomial.h"

namespace assay::detector {

// Exact binary fraction: value = number * 2^exponent.
using Wide = boost::multiprecision::cpp_int;
struct Exact {
  Wide number = 0;
  int exponent = 0;
  Exact() = default;
  Exact(double x) {  // NOLINT(google-explicit-constructor): the test computes with it
    const Binary b = binary_of(x);
    number = b.mantissa;
    exponent = b.exponent;
  }
};

inline Exact aligned_sum(const Exact& a, const Exact& b, int sign) {
  Exact out;
  out.exponent = std::min(a.exponent, b.exponent);
  out.number =
      (a.number << (a.exponent - out.exponent)) + sign * (b.number << (b.exponent - out.exponent));
  return out;
}
inline Exact operator+(const Exact& a, const Exact& b) { return aligned_sum(a, b, 1); }
inline Exact operator-(const Exact& a, const Exact& b) { return aligned_sum(a, b, -1); }
inline Exact operator*(const Exact& a, const Exact& b) {
  Exact out;
  out.number = a.number * b.number;
  out.exponent = a.exponent + b.exponent;
  return out;
}
// Returns |a| to within 2^-60 |a|.
inline double magnitude(const Exact& a) {
  Wide number = abs(a.number);
  if (number == 0) return 0;
  constexpr unsigned precision = 64;
  const unsigned bits = msb(number);
  const unsigned shift = bits > precision ? bits - precision : 0;
  number >>= shift;
  return std::ldexp(number.convert_to<double>(), a.exponent + static_cast<int>(shift));
}

using ExactVector = std::array<Exact, 3>;
struct MovingExact {
  ExactVector t0, t1;
};

inline MovingExact exact_difference(const MovingPoint& p, const MovingPoint& q) {
  MovingExact out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.t0[k] = Exact(p.t0[k]) - Exact(q.t0[k]);
    out.t1[k] = Exact(p.t1[k]) - Exact(q.t1[k]);
  }
  return out;
}
inline Exact dot(const ExactVector& x, const ExactVector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
inline ExactVector cross(const ExactVector& x, const ExactVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
inline ExactVector operator+(const ExactVector& x, const ExactVector& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}

class Numbers {
 public:
  double next() {
    switch (family_) {
      case 0:
        return std::uniform_real_distribution<double>(-1, 1)(engine_);
      case 1:  // far from the origin: the differences are rounded
        return 1e6 + std::uniform_real_distribution<double>(-1, 1)(engine_);
      case 2:  // mixed scales
        return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine_),
                          static_cast<int>(engine_() % 80) - 40);
      default:  // near the ends of the range
        return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine_),
                          engine_() % 2 ? 290 : 280);
    }
  }
  MovingPoint point() { return {{next(), next(), next()}, {next(), next(), next()}}; }
  void family(int n) { family_ = n; }

 private:
  std::mt19937_64 engine_{20111};
  int family_ = 0;
};

// Returns the error of `computed` in units of 2^-53 times the scale.
inline double error_units(double computed, const Exact& exact, double divisor, double scale) {
  // computed - exact / divisor, times divisor: all exact.
  const Exact off = Exact(computed) * Exact(divisor) - exact;
  return scale > 0 ? magnitude(off) / divisor / scale / unit_roundoff : magnitude(off);
}

}  // namespace assay::detector
