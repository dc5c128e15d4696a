// The sign of a polynomial at a root of another one: by plain signs on the root's interval, by the
// order of two roots, by a Tarski query.
#include "detector/exact/real_root.h"
#include "detector/exact/sturm.h"

namespace assay::detector {

int RealRoot::sign_of(const Polynomial& q) const {
  if (is_exact_ || q.degree() <= 0) return q.sign_at(lo_);
  const int at_lo = q.sign_at(lo_);
  if (q.degree() == 1) {
    const int at_hi = q.sign_at(hi_);
    if (at_lo == at_hi) return at_lo;
    if (at_lo == 0) return at_hi;
    if (at_hi == 0) return at_lo;
  } else if (at_lo != 0 && q.sign_at(hi_) == at_lo) {
    // q keeps its sign unless it turns around in between, and far enough to have roots.
    if (q.degree() == 2) {
      const Polynomial slope = q.derivative();
      if (slope.sign_at(lo_) * slope.sign_at(hi_) >= 0) return at_lo;
      if (Integer(q[1] * q[1] - 4 * q[0] * q[2]).sign() < 0) return at_lo;
    }
  }
  if (q.degree() == 2 && at_lo != 0 && q.sign_at(hi_) == -at_lo) return sign_by_order(q, at_lo);
  const SignedRemainders sequence(f_, f_.derivative() * q);
  return sequence.variations_at(lo_) - sequence.variations_at(hi_);
}

// q changes its sign once between lo and hi, at p. A positive multiple of f is (...) q + r with r
// of degree 1 at most: f(p) has the sign of r(p), and tells the order of p and the root of f. If r
// has different signs at lo and hi, q at the root of r tells the order of that and p in the same
// way.
int RealRoot::sign_by_order(const Polynomial& q, int q_lo) const {
  const Polynomial r = f_.remainder(q);
  const int r_lo = r.sign_at(lo_), r_hi = r.sign_at(hi_);
  int f_there = r_lo != 0 ? r_lo : r_hi;
  if (r_lo * r_hi < 0) {
    // r = a t + b: the sign of a^2 q(-b/a).
    const Integer &a = r[1], &b = r[0];
    const int there = Integer(q[2] * b * b - q[1] * a * b + q[0] * a * a).sign();
    f_there = there == 0 ? 0 : there == q_lo ? r_hi : r_lo;
  }
  if (f_there == 0) return 0;
  return f_there == f_.sign_at(lo_) ? -q_lo : q_lo;
}

}  // namespace assay::detector
