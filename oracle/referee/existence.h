// Proves that a hull of differences contains the origin at some time.
#pragma once

#include <cstdint>
#include <optional>

#include "oracle/referee/difference_hull.h"

namespace assay::oracle {

// Whether the hull contains the origin. Exact, for degenerate hulls too. A few us.
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
  int base = 0;  // the corner that plays P: u and v are counted from it
};

// Newton's method in double, started in the middle of [s,e]. Nothing when it does not converge to
// a place of the hull, up to rounding errors.
std::optional<Crossing> guess_crossing(const DoubleHull& hull, double s, double e);

// True: by the theorem of Poincare-Miranda some box about the guess holds a time and place at
// which the origin is in the hull. False: nothing is known.
// Let f(t,u,v) = P + u U + v V, and let g = A f with A the adjugate of the Jacobian of f at the
// guess (regular, checked). Each component of g is affine in each of t, u, v alone, so it takes
// its extremes on a side of the box at the side's four corners. If for every i component i is <= 0
// on one side of direction i and >= 0 on the other, g has a zero in the box, and so has f. The box
// lies in [0,until] x hull. REQUIRES until <= 1. All in integers; some 20 us a box.
bool crossing_in_a_box(const IntegerHull& hull, const Crossing& guess, double until = 1);

}  // namespace assay::oracle
