// Bernstein coefficients over [0,1] of products of linearly moving vectors, in double or
// float.
//
// A polynomial lies between the least and the greatest of its coefficients; the first and the last
// are its values at the ends. Error bounds of everything here, first order in u = 2^-53, for
// vectors whose coordinate k is a rounded difference of two doubles, off by at most u M_k with
// |coordinate k| <= M_k (second-order terms are below the slack of a few u in the constants):
//   minors      x y - z w: two products, each off by 2u M M (entries) + u M M (rounding), and the
//               difference, at most 2 M M, rounded: 8u M M
//   cross       middle coefficient (minor + minor) / 2, sum at most 4 M M rounded: 8u + 2u = 10u M
//   M dot         (x . y, both linear) each term 3u M M, two sums of at most 2 S and 3 S rounded
//   where
//               S is the sum of the three M M: 5u S; middle coefficient (x + y) / 2: 6u S
//   w . n       each of three terms: W 10u M M + 2 M M u W (entry) + 2u W M M (rounding) = 14u W M
//   M;
//               partial sums at most 2 S and 2 S, S the sum of the three W M M: 18u S
//   (2x + y)/3  18u S; the sum, at most 6 S, rounded: 2u S; the quotient, at most 2 S: 2u S; 22u S
//   halving     (x + y) / 2 rounded by u max|coefficient|; older errors are averaged, not added;
//               three levels for a cubic, two for a quadratic
// All hold while no product overflows and underflow stays below them: see `in_range`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "detector/bernstein/bounds.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

template <class T>
using VectorOf = std::array<T, 3>;
template <class T>
using QuadraticOf = std::array<T, 3>;  // Bernstein coefficients
template <class T>
using CubicOf = std::array<T, 4>;

using Vector = VectorOf<double>;
using Quadratic = QuadraticOf<double>;
using Cubic = CubicOf<double>;

// An underflow costs at most 2^-1074 an operation, and at most 2^-1074 2^300 where a product that
// underflowed is multiplied once more by M_k; within this range the bounds there are above
// 2^-53 2^-600 M_k, far more.
inline constexpr double least_magnitude = 0x1p-300;
inline constexpr double greatest_magnitude = 0x1p300;

template <class T>
struct MovingVectorOf {
  VectorOf<T> t0, t1;
};
using MovingVector = MovingVectorOf<double>;

// Of the coordinates as T has them.
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

// w . (x cross y)
template <class T>
CubicOf<T> triple_product(const MovingVectorOf<T>& w, const CrossQuadraticOf<T>& n) {
  return {dot(w.t0, n.b0), (2 * dot(w.t0, n.b1) + dot(w.t1, n.b0)) / 3,
          (dot(w.t0, n.b2) + 2 * dot(w.t1, n.b1)) / 3, dot(w.t1, n.b2)};
}

// Coefficients over the two halves of the interval.
template <class T, std::size_t n>
void halve(const std::array<T, n>& b, std::array<T, n>& left, std::array<T, n>& right) {
  std::array<T, n> row = b;
  for (std::size_t level = 0; level < n; ++level) {
    left[level] = row[0];
    right[n - 1 - level] = row[n - 1 - level];
    for (std::size_t i = 0; i + 1 + level < n; ++i) row[i] = (row[i] + row[i + 1]) / 2;
  }
}

// Largest size of each coordinate over the step.
template <class T>
void grow(std::array<T, 3>& magnitude, const MovingVectorOf<T>& v) {
  for (std::size_t k = 0; k < 3; ++k) {
    magnitude[k] = std::max({magnitude[k], std::abs(v.t0[k]), std::abs(v.t1[k])});
  }
}

inline bool in_range(const Vector& magnitude) {
  return std::all_of(magnitude.begin(), magnitude.end(), [](double m) {
    return m == 0 || (m > least_magnitude && m < greatest_magnitude);
  });
}

// 1 or -1 when the value is beyond the bound on that side, else 0.
template <class T>
int sign_beyond(T value, T bound) {
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

// The same of all coefficients: the sign of the polynomial over the interval.
template <class T, std::size_t n>
int sure_sign(const std::array<T, n>& b, T bound) {
  const auto [least, greatest] = std::minmax_element(b.begin(), b.end());
  return *least > bound ? 1 : *greatest < -bound ? -1 : 0;
}

}  // namespace assay::detector
