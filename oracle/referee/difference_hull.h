// The moving hull of differences of a query: the one object that the referee looks at.
//
// Two convex hulls meet exactly when the hull of all differences (a point of the first minus a
// point of the second) contains the origin. For vertex-face that is a triangle, for edge-edge a
// parallelogram; its corners move linearly. So the question of contact is: does a moving triangle
// or parallelogram pass over the origin?
//
// Notation of the referee: c_0, c_1, c_2 are the corners (and c_3 = c_1 + c_2 - c_0 of a
// parallelogram); P = c_0, U = c_1 - c_0, V = c_2 - c_0. The hull is P + u U + v V with u, v >= 0
// and u + v <= 1 (triangle) or u, v <= 1 (parallelogram).
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
struct Hull {
  std::array<Vector<Number>, 4> corner;
  int corners = 3;
};

// Vector arithmetic that directions in doubles and in integers share.
template <class Number>
Vector<Number> minus(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}
template <class Number>
Vector<Number> plus(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[0] + b[0]), Number(a[1] + b[1]), Number(a[2] + b[2])};
}
template <class Number>
Vector<Number> times(const Vector<Number>& a, const Number& s) {
  return {Number(a[0] * s), Number(a[1] * s), Number(a[2] * s)};
}
template <class Number>
Number inner(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Vector<Number> outer(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
          Number(a[0] * b[1] - a[1] * b[0])};
}

// The corners at t=0 and t=1 in double, times the power of two, 2^-exponent, that brings the
// largest coordinate into [1/2,1]. `usable` is false when a difference overflows. Coordinate k of a
// corner, at either end, is wrong by at most u * size[k] + 2^-1074 (u = 2^-53): the difference is
// rounded once, and the scaling is exact above the denormals.
struct DoubleHull {
  Hull<double> t0, t1;
  Vector<double> size = {};  // largest |coordinate| of a corner as computed, at least 2^-900
  int exponent = 0;
  bool usable = false;

  // The corners at t in [0,1], a multiple of 2^-53. Wrong by at most 3.01 u size[k] + 2^-1072
  // (derived in existence.cpp).
  Hull<double> at(double t) const;
};

// The same corners, exact: times 2^-unit, which makes all coordinates integers.
struct IntegerHull {
  Hull<mpz_class> t0, t1;
  int unit = 0;

  // q times the corners at time p/q, 0 <= p <= q.
  Hull<mpz_class> at(std::int64_t p, std::int64_t q) const;
};

DoubleHull double_hull(const detector::VertexFace& query);
DoubleHull double_hull(const detector::EdgeEdge& query);
IntegerHull integer_hull(const detector::VertexFace& query);
IntegerHull integer_hull(const detector::EdgeEdge& query);

// A hull of doubles that is near a positive multiple of the integer hull: all coordinates are
// divided by one power of two, and each is rounded once. For guesses only.
Hull<double> rounded(const Hull<mpz_class>& hull);

// The point of the hull nearest to the origin, as doubles compute it: a guess, never a verdict.
// The weights of the corners are >= 0 and sum to about 1.
struct NearestPoint {
  Vector<double> point = {};
  std::array<double, 4> weight = {};
};
NearestPoint nearest_to_origin(const Hull<double>& hull);

}  // namespace assay::oracle
