// Computes Bernstein coefficients over [0,1] of products of linearly moving vectors, in double or
// float.
//
// Over the interval a polynomial lies between the least and the greatest of its Bernstein
// coefficients. The first and the last coefficient are the values of the polynomial at 0 and at 1.
//
// Error bounds. Every filter of the detector derives its bound from the table below, and writes
// the derivation in the same notation:
//   u         2^-53. An operation rounds its result by at most u times the size of that result.
//   M         bounds the size of an entry. An entry is a coordinate of a vector at t=0 or t=1.
//   MM, WMM   products of the bounds M of the entries that the row multiplies.
//   S, T      sums over the three coordinates: S sums MM (for x . y), T sums WMM (for w . n).
//   B         the largest size among the coefficients that are halved.
//   error     in units of u. First comes the error that the operands bring into the result, then
//             the rounding of each operation in turn: 3 + 3 + 2 = 8 MM stands for 8 u MM.
//   middle    a coefficient that is neither the first nor the last. Its error is larger.
// A division by 2 and a product with 2 are exact. The table has errors of first order in u. The
// constants in the code are larger by some u, and these cover errors of second order.
//
//   quantity         | operations                    | error in u                     | size
//   entry            | a difference of two doubles   | 1 M                            | M
//   x y              | a product of two entries      | 1 + 1 + 1 = 3 MM               | MM
//   minor            | x y - z w                     | 3 + 3 + 2 = 8 MM               | 2 MM
//   cross, middle    | (minor + minor) / 2           | (8 + 8 + 4) / 2 = 10 MM        | 2 MM
//   x . y            | three x y, two sums           | 3 + 1 + 1 = 5 S                | S
//   x . y, middle    | (x . y + x . y) / 2           | (5 + 5 + 2) / 2 = 6 S          | S
//   w n              | an entry w times a cross      | 10 + 2 + 2 = 14 WMM            | 2 WMM
//   w . n            | three w n, two sums           | 14 + 2 + 2 = 18 T              | 2 T
//   w . n, middle    | (2 (w . n) + w . n) / 3       | (36 + 18 + 6) / 3 + 2 = 22 T   | 2 T
//   quadratic halved | (x + y) / 2 at two levels     | as before + 1 + 1 = + 2 B      | B
//   cubic halved     | (x + y) / 2 at three levels   | as before + 1 + 1 + 1 = + 3 B  | B
//
// Halving averages older errors and never adds them up. The table holds if no product overflows and
// if underflows stay below the bounds; in_range() says whether this is so.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "detector/mesh/step_types.h"

namespace assay::detector {

// The policy of a filter: in which numbers it computes, and by how much a computed number is
// assumed to be off. Filters are written once, as templates over this policy.
//
// Every error bound is a derived constant times `unit`. With unit 0 the bounds are 0: then the sign
// of a computed number is taken for its true sign, also if the computed number is 0.

inline constexpr double unit_roundoff = 0x1p-53;

// Doubles with bounds that hold: each rounding is off by at most 2^-53 of the result.
struct ProvedBounds {
  using Number = double;
  static constexpr bool proved = true;
  static constexpr Number unit = unit_roundoff;
};

// Plain arithmetic in T, without bounds.
template <class T>
struct NoBounds {
  using Number = T;
  static constexpr bool proved = false;
  static constexpr Number unit = 0;
};

template <class T>
using VectorOf = std::array<T, 3>;
template <class T>
using QuadraticOf = std::array<T, 3>;  // Bernstein coefficients
template <class T>
using CubicOf = std::array<T, 4>;

using Vector = VectorOf<double>;
using Quadratic = QuadraticOf<double>;
using Cubic = CubicOf<double>;

// The range of magnitudes within which the bounds hold. An underflow costs at most 2^-1074 in an
// operation, and at most 2^-1074 2^300 if a product that underflowed is multiplied once more by
// M_k. Within this range the bounds of such products exceed this: they are above 2^-53 2^-600 M_k.
inline constexpr double least_magnitude = 0x1p-300;
inline constexpr double greatest_magnitude = 0x1p300;

template <class T>
struct MovingVectorOf {
  VectorOf<T> t0, t1;
};
using MovingVector = MovingVectorOf<double>;

// Returns p - q at both ends of the step, computed from the coordinates rounded to T.
template <class T = double>
MovingVectorOf<T> difference(const MovingPoint& p, const MovingPoint& q) {
  MovingVectorOf<T> d;
  for (std::size_t k = 0; k < 3; ++k) {
    d.t0[k] = static_cast<T>(p.t0[k]) - static_cast<T>(q.t0[k]);
    d.t1[k] = static_cast<T>(p.t1[k]) - static_cast<T>(q.t1[k]);
  }
  return d;
}

template <class T>
T dot(const std::array<T, 3>& x, const std::array<T, 3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <class T>
VectorOf<T> cross(const std::array<T, 3>& x, const std::array<T, 3>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

template <class T>
QuadraticOf<T> dot(const MovingVectorOf<T>& x, const MovingVectorOf<T>& y) {
  return {dot(x.t0, y.t0), (dot(x.t0, y.t1) + dot(x.t1, y.t0)) / 2, dot(x.t1, y.t1)};
}

template <class T>
struct CrossQuadraticOf {
  VectorOf<T> b0, b1, b2;
};
using CrossQuadratic = CrossQuadraticOf<double>;

template <class T>
CrossQuadraticOf<T> cross(const MovingVectorOf<T>& x, const MovingVectorOf<T>& y) {
  const VectorOf<T> a = cross(x.t0, y.t1), b = cross(x.t1, y.t0);
  return {cross(x.t0, y.t0),
          {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2},
          cross(x.t1, y.t1)};
}

// Returns w . (x cross y).
template <class T>
CubicOf<T> triple_product(const MovingVectorOf<T>& w, const CrossQuadraticOf<T>& n) {
  return {dot(w.t0, n.b0), (2 * dot(w.t0, n.b1) + dot(w.t1, n.b0)) / 3,
          (dot(w.t0, n.b2) + 2 * dot(w.t1, n.b1)) / 3, dot(w.t1, n.b2)};
}

// Sets `left` and `right` to the coefficients over the two halves of the interval.
template <class T, std::size_t n>
void halve(const std::array<T, n>& b, std::array<T, n>& left, std::array<T, n>& right) {
  std::array<T, n> row = b;
  for (std::size_t level = 0; level < n; ++level) {
    left[level] = row[0];
    right[n - 1 - level] = row[n - 1 - level];
    for (std::size_t i = 0; i + 1 + level < n; ++i) row[i] = (row[i] + row[i + 1]) / 2;
  }
}

// Does the same for m polynomials whose coefficients lie side by side.
template <class T, std::size_t m, std::size_t n>
void halve(const std::array<std::array<T, m>, n>& b, std::array<std::array<T, m>, n>& left,
           std::array<std::array<T, m>, n>& right) {
  auto row = b;
  for (std::size_t level = 0; level < n; ++level) {
    left[level] = row[0];
    right[n - 1 - level] = row[n - 1 - level];
    for (std::size_t i = 0; i + 1 + level < n; ++i) {
      for (std::size_t j = 0; j < m; ++j) row[i][j] = (row[i][j] + row[i + 1][j]) / 2;
    }
  }
}

// Raises each coordinate of `magnitude` to the largest size of that coordinate of v over the step,
// unless it is larger already.
template <class T>
void grow(std::array<T, 3>& magnitude, const MovingVectorOf<T>& v) {
  for (std::size_t k = 0; k < 3; ++k) {
    magnitude[k] = std::max({magnitude[k], std::abs(v.t0[k]), std::abs(v.t1[k])});
  }
}

// Returns whether the error bounds hold for vectors with coordinates of these magnitudes.
inline bool in_range(const Vector& magnitude) {
  return std::all_of(magnitude.begin(), magnitude.end(), [](double m) {
    return m == 0 || (m > least_magnitude && m < greatest_magnitude);
  });
}

// Returns 1 if value > bound, -1 if value < -bound, else 0.
template <class T>
int sign_beyond(T value, T bound) {
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

// Returns 1 if all coefficients are > bound, -1 if all are < -bound, else 0. If the coefficients
// are off by at most `bound`, 1 and -1 are the sign of the polynomial over the whole interval.
template <class T, std::size_t n>
int sure_sign(const std::array<T, n>& b, T bound) {
  // Compares values and not indices, because indices would need branches.
  T least = b[0], greatest = b[0];
  for (std::size_t i = 1; i < n; ++i) {
    least = std::min(least, b[i]);
    greatest = std::max(greatest, b[i]);
  }
  return least > bound ? 1 : greatest < -bound ? -1 : 0;
}

}  // namespace assay::detector
