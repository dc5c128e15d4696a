// Rigorous existence: a hull of differences does contain the origin at some time.
#pragma once

#include <cstdint>
#include <optional>

#include "oracle/referee/difference_hull.h"

namespace assay::oracle {

// Whether the hull contains the origin, exactly; degenerate hulls included. A few us.
bool contains_origin(const Hull<mpz_class>& hull);

// A fraction p/q in lowest terms.
struct Fraction {
  std::int64_t p = 0, q = 1;
  friend bool operator==(const Fraction&, const Fraction&) = default;
};

// The fraction with the least denominator in [k/2^depth, (k+1)/2^depth], depth <= 61.
Fraction simplest_fraction(std::int64_t k, int depth);

// A guess at a time and place where the origin lies in the hull.
struct Crossing {
  double t = 0, u = 0, v = 0;
  int base = 0;  // the corner that u and v are counted from, see crossing_in_a_box
};

// Newton's method in double from the middle of [s,e]; nothing when it does not converge to a place
// of the hull, up to rounding errors.
std::optional<Crossing> guess_crossing(const DoubleHull& hull, double s, double e);

// Poincare-Miranda: g = A f on a box about the guess, f(t,u,v) = P + u U + v V, A the adjugate of
// the Jacobian of f at the guess (regular, checked). Each component of g is affine in each of t, u,
// v alone, so its extremes on a side of the box are at the side's four corners. When component i is
// <= 0 on one side of direction i and >= 0 on the other, for all three, g has a zero in the box and
// so has f. The box lies in [0,until] x hull, until at most 1. All in integers; some 20 us a box.
// False says nothing.
bool crossing_in_a_box(const IntegerHull& hull, const Crossing& guess, double until = 1);

}  // namespace assay::oracle
