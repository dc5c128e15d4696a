// The moving hull of differences of a query: the one object that the referee looks at.
//
// Two convex hulls meet exactly when the hull of all differences (a point of the first minus a
// point of the second) contains the origin. This hull is a triangle for vertex-face and a
// parallelogram for edge-edge; its corners move linearly. So the question of contact is: does a
// moving triangle or parallelogram pass over the origin?
//
// Notation of the referee: c_0, c_1, c_2 are the corners (and c_3 = c_1 + c_2 - c_0 of a
// parallelogram); P = c_0, U = c_1 - c_0, V = c_2 - c_0. The hull is P + u U + v V with u, v >= 0
// and u + v <= 1 (triangle) or u, v <= 1 (parallelogram).
//
// The referee has two proofs: that the hull contains the origin at some time, and that the hull
// stays away from the origin on a piece of the step.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
struct Hull {
  std::array<Vector<Number>, 4> corner;
  int corners = 3;
};

// Vector arithmetic, for directions in doubles and in integers.
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
// largest coordinate into [1/2,1]. `usable` is false when a difference overflows. The error of
// coordinate k of a corner, at t=0 and at t=1, is at most u * size[k] + 2^-1074 (u = 2^-53): the
// difference is rounded once, and the scaling is exact above the denormals.
struct DoubleHull {
  Hull<double> t0, t1;
  Vector<double> size = {};  // largest |coordinate| of a corner as computed, at least 2^-900
  int exponent = 0;
  bool usable = false;

  // Returns the corners at t in [0,1], a multiple of 2^-53. The error of coordinate k is at most
  // 3.01 u size[k] + 2^-1072 (derived in existence.cpp).
  Hull<double> at(double t) const;
};

// The exact corners, multiplied by 2^-unit, which makes all coordinates integers.
struct IntegerHull {
  Hull<mpz_class> t0, t1;
  int unit = 0;

  // Returns q times the corners at time p/q, 0 <= p <= q.
  Hull<mpz_class> at(std::int64_t p, std::int64_t q) const;
};

DoubleHull double_hull(const detector::FourPoints& query);
IntegerHull integer_hull(const detector::FourPoints& query);

// Returns a hull of doubles that is near a positive multiple of the integer hull: all coordinates
// are divided by one power of two, and each is rounded once. For guesses only.
Hull<double> rounded(const Hull<mpz_class>& hull);

// The point of the hull nearest to the origin, as doubles compute it: a guess, never a verdict.
// The weights of the corners are >= 0 and sum to about 1.
struct NearestPoint {
  Vector<double> point = {};
  std::array<double, 4> weight = {};
};
NearestPoint nearest_to_origin(const Hull<double>& hull);

// Proves that a hull of differences stays away from the origin on a piece of the step.
//
// The proof is a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), for which the three
// numbers n_s.c(s), n_s.c(e) + n_e.c(s), n_e.c(e) are > 0 for every corner c. They are the
// Bernstein coefficients (the middle one doubled) of the quadratic n(t).c(t), which is then > 0 on
// all of [s,e]: the hull lies strictly on one side of a plane through the origin at every time of
// the piece. If n_s = n_e, the direction is constant, and the swept hull itself is separated.

// `near`: no tried direction surely separates, and rounding errors hide whether some direction
// does, or a difference overflows in double. Integers may be able to prove the separation.
enum class SeparationProof : std::uint8_t { separated, near, not_found };

// Looks for a proof on [s,e], in double with error bounds. REQUIRES 0 <= s < e <= 1, both multiples
// of 2^-53. About 1 us.
SeparationProof separated_in_double(const DoubleHull& hull, double s, double e);

// Looks for a proof on [k/2^depth, (k+1)/2^depth], in integers. REQUIRES depth <= 61. False says
// nothing. Tens of us.
bool separated_in_integers(const IntegerHull& hull, std::int64_t k, int depth);

// Returns whether the hull contains the origin. Exact, for degenerate hulls too. A few us.
bool contains_origin(const Hull<mpz_class>& hull);

// A fraction p/q in lowest terms.
struct Fraction {
  std::int64_t p = 0, q = 1;
  friend bool operator==(const Fraction&, const Fraction&) = default;
};

// Returns the fraction with the least denominator in [k/2^depth, (k+1)/2^depth], depth <= 61.
Fraction simplest_fraction(std::int64_t k, int depth);

// A guess at a time and place where the origin lies in the hull.
struct Crossing {
  double t = 0, u = 0, v = 0;
  int base = 0;  // the corner that serves as P; u and v start from it
};

// Guesses by Newton's method in double, started in the middle of [s,e]. Returns nothing when it
// does not converge to a place of the hull, up to rounding errors.
std::optional<Crossing> guess_crossing(const DoubleHull& hull, double s, double e);

// Returns true if, by the theorem of Poincare-Miranda, some box about the guess holds a time and
// place at which the origin is in the hull. False says nothing.
// Let f(t,u,v) = P + u U + v V, and let g = A f with A the adjugate of the Jacobian of f at the
// guess (regular, checked). Each component of g is affine in each of t, u and v, so it takes
// its extremes on a side of the box at the side's four corners. If, for every i, component i is <=
// 0 on one side of direction i and >= 0 on the other side, g has a zero in the box, and so has f.
// The box lies in [0,until] x hull. REQUIRES until <= 1. All in integers; some 20 us a box.
bool crossing_in_a_box(const IntegerHull& hull, const Crossing& guess, double until = 1);

}  // namespace assay::oracle
