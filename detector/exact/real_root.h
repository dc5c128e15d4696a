// The distinct real roots of an integer polynomial in [0,1], their unique enclosures in doubles,
// and the exact sign of another polynomial at a root.
//
// Method: multiple roots are made simple (polynomial.h), then Descartes' rule tells the roots
// apart (root_isolation.h). Signs at doubles enclose each root. The sign of another polynomial at a
// root follows from its signs on the root's interval, or, if these do not tell, from the order of
// two roots (real_root.cpp). Every sign is first computed in balls (ball.h). Nothing here is
// recursive: intervals wait in lists.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

class RealRoot {
 public:
  // A root at a known time.
  explicit RealRoot(const Dyadic& exact_time);
  // The same, where `doubles` encloses the time: it is that double, or the two doubles around it.
  RealRoot(const Dyadic& exact_time, TimeEnclosure doubles);
  // The root of f in the open interval (lo, hi). REQUIRES that f has one root there, a simple one,
  // and the sign sign_after_lo between lo and the root. f may vanish at lo and hi.
  RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, int sign_after_lo,
           TimeEnclosure doubles);

  // Returns the exact sign of q at this root. If q has a degree above 2 and roots close to this
  // one, all of these are told apart first: 50 us and more.
  int sign_of(const Polynomial& q) const;
  const TimeEnclosure& enclosure() const { return enclosure_; }

 private:
  bool is_exact() const { return sign_after_lo_ == 0; }
  // Does the same for a q with roots in (lo, hi) that has the signs after_lo and before_hi just
  // inside the ends of the interval.
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

// Returns whether f has a root in [0,1]. This costs less than to find the roots.
bool has_root_in_unit_interval(const Polynomial& f);

// Returns the enclosure of the root of f in (lo, hi). REQUIRES that f has one root there, that
// f(lo) f(hi) < 0, and that lo and hi are in [0,1]. `guess` may be any value; a good one saves
// time.
TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess);

}  // namespace assay::detector
