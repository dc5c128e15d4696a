// The sign of a polynomial q of degree 2 at most at the root of f in (lo,hi). f changes its sign
// at its root and nowhere else in (lo,hi), so the sign of f at a root p of q tells the order of
// the two roots. A positive multiple of f is (...) q + r with r of degree 1 at most, so f(p) has
// the sign of r(p). If r has a root in (lo,hi), the sign of q at that root tells the order of the
// root and p.
//
//   roots of q in (lo,hi)  | q at the root of f
//   none                   | the sign that q has throughout
//   p                      | before p the sign of q after lo, behind p that of q before hi
//   p1 <= p2               | the sign of q after lo, but the other one when f has different signs
//                          | at p1 and p2, and 0 when f vanishes at one of them
#include <cassert>

#include "detector/exact/real_root.h"

namespace assay::detector {
namespace {

// The signs of a polynomial of degree 2 at most just inside the ends of an open interval.
struct EndSigns {
  int after_lo, before_hi;
};

EndSigns end_signs(const Polynomial& q, const Dyadic& lo, const Dyadic& hi) {
  const Polynomial slope = q.derivative();
  const int bend = slope.derivative().sign_at_zero();
  const auto first_of = [](int a, int b, int c) { return a != 0 ? a : b != 0 ? b : c; };
  return {first_of(q.sign_at(lo), slope.sign_at(lo), bend),
          first_of(q.sign_at(hi), -slope.sign_at(hi), bend)};
}

// The sign of q at the root -b/a of a t + b.
int sign_at_root_of_linear(const Polynomial& q, const Polynomial& linear) {
  const Integer &a = linear[1], &b = linear[0];
  return Integer(q[2] * b * b - q[1] * a * b + q[0] * a * a).sign();
}

}  // namespace

int RealRoot::sign_of(const Polynomial& q) const {
  assert(q.degree() <= 2);
  if (is_exact() || q.degree() <= 0) return q.sign_at(lo_);
  const int at_lo = q.sign_at(lo_), at_hi = q.sign_at(hi_);
  if (q.degree() == 1 && at_lo * at_hi >= 0) return at_lo != 0 ? at_lo : at_hi;
  if (q.degree() == 2 && at_lo * at_hi > 0) {
    // q has roots in (lo,hi) only if it turns around there, towards 0 and far enough.
    if (at_lo != q[2].sign()) return at_lo;
    const Polynomial slope = q.derivative();
    if (slope.sign_at(lo_) * slope.sign_at(hi_) >= 0) return at_lo;
    if (Integer(q[1] * q[1] - 4 * q[0] * q[2]).sign() < 0) return at_lo;
    return sign_by_order(q, at_lo, at_lo);
  }
  const auto [after_lo, before_hi] = end_signs(q, lo_, hi_);
  // If q has the same sign at both ends and a root at one end, its other root is not in (lo,hi).
  if (after_lo == before_hi) return after_lo;
  return sign_by_order(q, after_lo, before_hi);
}

int RealRoot::sign_by_order(const Polynomial& q, int after_lo, int before_hi) const {
  const Polynomial r = f_.remainder(q);
  if (r.is_zero()) return 0;  // q divides f: its root in between is that of f
  const EndSigns of_r = end_signs(r, lo_, hi_);
  const bool r_changes = of_r.after_lo != of_r.before_hi;
  const int q_there = !r_changes ? after_lo : q.degree() == 2 ? sign_at_root_of_linear(q, r) : 0;
  if (r_changes && q_there == 0) return 0;
  if (after_lo == before_hi) return q_there;
  const int f_there = r_changes && q_there == after_lo ? of_r.before_hi : of_r.after_lo;
  return f_there == sign_after_lo_ ? before_hi : after_lo;
}

}  // namespace assay::detector
