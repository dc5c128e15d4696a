// Distinct real roots of an integer polynomial in [0,1], their unique enclosures in doubles, and
// the exact sign of another polynomial at a root.
//
// Method: Sturm sequences count roots between two times; bisection over the DOUBLES (their order
// as integers, at most 62 halvings whatever the exponents) isolates them; only roots that share
// one gap between adjacent doubles are isolated further by dyadic midpoints. The sign of q at a
// root of f is the difference of sign variations of the sequence of (f, f'q) at the two ends of
// its isolating interval (Tarski query; Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry,
// Theorem 2.61), used when neither plain signs on the interval tell nor, for a quadratic with one
// root there, the order of the two roots.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

class RealRoot {
 public:
  explicit RealRoot(const Dyadic& exact_time);
  // The one root of f in the open interval (lo, hi), where f(lo) f(hi) < 0.
  RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, TimeEnclosure doubles);

  // Exact sign of q here.
  int sign_of(const Polynomial& q) const;
  const TimeEnclosure& enclosure() const { return enclosure_; }

 private:
  int sign_by_order(const Polynomial& q, int q_lo) const;

  bool is_exact_ = false;
  Dyadic lo_, hi_;  // both the root itself when exact
  Polynomial f_;
  TimeEnclosure enclosure_;
};

// Ascending. f must not be zero. Cost: a few us for a cubic with 200-bit coefficients.
std::vector<RealRoot> roots_in_unit_interval(const Polynomial& f);

// Whether f has a root in [0,1]; cheaper than the roots themselves.
bool has_root_in_unit_interval(const Polynomial& f);

// The enclosure of the one root of f in (lo, hi), where f(lo) f(hi) < 0: doubles in [0,1].
// `guess` (any value) only saves time.
TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess);

}  // namespace assay::detector
