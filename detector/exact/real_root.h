// Distinct real roots of an integer polynomial in [0,1], their unique enclosures in doubles, and
// the exact sign of a quadratic at a root.
//
// Method: Descartes' rule tells the roots apart (root_isolation.h), after multiple ones are made
// simple (square_free.h); signs at doubles enclose each; a sign at a root is that of plain signs
// on the root's interval, or where these do not tell of the order of two roots (root_sign.cpp).
// Every sign is asked of balls first (ball.h). Nothing here is recursive: intervals wait in lists.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

class RealRoot {
 public:
  explicit RealRoot(const Dyadic& exact_time);
  // A time of which the double, or the two around it, is known.
  RealRoot(const Dyadic& exact_time, TimeEnclosure doubles);
  // The one root of f in the open interval (lo, hi), a simple one; f has that sign from lo to it.
  // f may vanish at lo and hi.
  RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, int sign_after_lo,
           TimeEnclosure doubles);

  // Exact sign of q, of degree 2 at most, here.
  int sign_of(const Polynomial& q) const;
  const TimeEnclosure& enclosure() const { return enclosure_; }

 private:
  bool is_exact() const { return sign_after_lo_ == 0; }
  // q has roots in (lo, hi), and these signs around them.
  int sign_by_order(const Polynomial& q, int after_lo, int before_hi) const;

  Dyadic lo_, hi_;  // both the root itself when exact
  int sign_after_lo_ = 0;
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
