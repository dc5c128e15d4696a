// The distinct real roots of an integer polynomial in [0,1], their unique enclosures in doubles,
// and the exact sign of another polynomial at a root.
//
// Method: multiple roots are made simple (polynomial.h), then Descartes' rule isolates the roots
// (root_isolation.h). The signs of the polynomial at doubles enclose each root. The sign of another
// polynomial at a root follows from the signs of that polynomial on the root's interval. If these
// signs do not tell, it follows from the order of two roots (real_root.cpp). Every sign is first
// computed in balls (ball.h). Nothing here is recursive: lists hold the intervals that are not done
// yet.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

class RealRoot {
 public:
  // A root at a known time.
  explicit RealRoot(const Dyadic& exact_time);
  // A root at a known time, where `doubles` encloses that time: both of its ends are the time, or
  // they are the two adjacent doubles around the time.
  RealRoot(const Dyadic& exact_time, TimeEnclosure doubles);
  // The root of f in the open interval (lo, hi). REQUIRES that f has exactly one root in the
  // interval, that this root is simple, and that f has the sign sign_after_lo between lo and the
  // root. f may vanish at lo and hi.
  RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, int sign_after_lo,
           TimeEnclosure doubles);

  // Returns the exact sign of q at this root. If q has a degree above 2 and roots close to this
  // one, all these roots are isolated first, which takes 50 us and more.
  int sign_of(const Polynomial& q) const;
  const TimeEnclosure& enclosure() const { return enclosure_; }

 private:
  bool is_exact() const { return sign_after_lo_ == 0; }
  // Does the same for a q that has roots in (lo, hi), the sign after_lo just after lo, and the sign
  // before_hi just before hi.
  int sign_by_order(const Polynomial& q, int after_lo, int before_hi) const;
  // Does the same for a q of any degree.
  int sign_beside_roots(const Polynomial& q) const;

  Dyadic lo_, hi_;  // both are the root itself if is_exact()
  int sign_after_lo_ = 0;
  Polynomial f_;
  TimeEnclosure enclosure_;
};

// Returns the roots, ascending. REQUIRES that f is not zero. Cost: a few us for a cubic with
// 200-bit coefficients.
std::vector<RealRoot> roots_in_unit_interval(const Polynomial& f);

// Returns whether f has a root in [0,1]. This costs less than finding the roots.
bool has_root_in_unit_interval(const Polynomial& f);

// Returns the enclosure of the root of f in (lo, hi). REQUIRES that f has exactly one root in (lo,
// hi), that f(lo) f(hi) < 0, and that lo and hi are in [0,1]. `guess` may be any value; a good one
// saves time.
TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess);

}  // namespace assay::detector
