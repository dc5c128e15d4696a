// The referee's two proofs: that a hull of differences contains the origin at some time, and that
// it stays away from the origin on a piece of the step.
#pragma once

#include <cstdint>
#include <optional>

#include "oracle/referee/difference_hull.h"

namespace assay::oracle {

// Proves that a hull of differences stays away from the origin on a piece of the step.
//
// The proof is a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), for which the three
// numbers n_s.c(s), n_s.c(e) + n_e.c(s), n_e.c(e) are > 0 for every corner c. They are the
// Bernstein coefficients (the middle one doubled) of the quadratic n(t).c(t), which is then > 0 on
// all of [s,e]: the hull lies strictly on one side of a plane through the origin at every time of
// the piece. If n_s = n_e, the direction is constant, and the swept hull itself is separated.

// near: no direction that was tried surely separates, but for one of them rounding errors leave it
// open, or a difference overflows in double. Integers may yet prove it.
enum class SeparationProof : std::uint8_t { separated, near, not_found };

// On [s,e]. REQUIRES 0 <= s < e <= 1, both multiples of 2^-53. In double with error bounds; about
// 1 us.
SeparationProof separated_in_double(const DoubleHull& hull, double s, double e);

// On [k/2^depth, (k+1)/2^depth]. REQUIRES depth <= 61. In integers; tens of us. False: nothing is
// known.
bool separated_in_integers(const IntegerHull& hull, std::int64_t k, int depth);

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
