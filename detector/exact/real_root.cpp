#include "detector/exact/real_root.h"

#include <array>
#include <cassert>
#include <cmath>

#include "detector/exact/root_isolation.h"

namespace assay::detector {
namespace {

// Returns about where f changes sign between lo and hi, in plain double arithmetic. This is a guess
// that saves exact evaluations and decides nothing.
double approximate_root(const Polynomial& f, double lo, double hi) {
  constexpr unsigned kept_bits = 900;  // far inside the range of double
  unsigned most_bits = 0;
  for (int i = 0; i <= f.degree(); ++i) {
    if (!f[i].is_zero()) most_bits = std::max(most_bits, static_cast<unsigned>(msb(abs(f[i]))));
  }
  const unsigned dropped = most_bits > kept_bits ? most_bits - kept_bits : 0;
  std::array<double, 8> c{};
  if (f.degree() >= static_cast<int>(c.size())) return (lo + hi) / 2;
  for (int i = 0; i <= f.degree(); ++i) {
    c[static_cast<std::size_t>(i)] = Integer(f[i] >> dropped).convert_to<double>();
  }
  const auto value_at = [&](double t) {
    double value = 0;
    for (int i = f.degree(); i >= 0; --i) value = value * t + c[static_cast<std::size_t>(i)];
    return value;
  };
  const bool rising = value_at(lo) < value_at(hi);
  constexpr int halvings = 56;
  for (int i = 0; i < halvings; ++i) {
    const double middle = lo + (hi - lo) / 2;
    ((value_at(middle) < 0) == rising ? lo : hi) = middle;
  }
  return lo;
}

RealRoot enclosed(const Polynomial& f, const IsolatedRoot& root) {
  if (root.is_time()) return {root.lo, root.doubles};
  const auto [lo, hi] = root.doubles;
  if (adjacent(lo, hi)) return {f, root.lo, root.hi, root.sign_after_lo, root.doubles};
  const auto doubles = bracket_root([&f](double time) { return f.sign_at(Dyadic::of(time)); },
                                    root.sign_after_lo, lo, hi, approximate_root(f, lo, hi));
  if (doubles.lo == doubles.hi) return {Dyadic::of(doubles.lo), doubles};
  return {f, Dyadic::of(doubles.lo), Dyadic::of(doubles.hi), root.sign_after_lo, doubles};
}

// Returns the isolated roots of `simple`, the square-free part of f. REQUIRES that f has the sign
// changes of_f over (0,1).
std::vector<IsolatedRoot> isolated_roots(const Polynomial& simple, const Polynomial& f,
                                         SignChanges of_f, Roots scope) {
  const bool is_f = simple.degree() == f.degree();
  return isolate_roots(simple, is_f ? of_f : sign_changes_over_unit(simple), scope);
}

// Returns the double that a dyadic time is, or the two adjacent doubles around it.
TimeEnclosure doubles_around(const Dyadic& time) {
  const Integer scale = Integer(1) << static_cast<unsigned>(-time.exponent);
  const Polynomial f = Polynomial::linear(-time.mantissa, scale - time.mantissa);
  if (f.sign_at_zero() == 0) return {0, 0};
  if (f.sign_at_one() == 0) return {1, 1};
  return enclose_single_root(f, 0, 1, -1);
}

}  // namespace

RealRoot::RealRoot(const Dyadic& exact_time) : RealRoot(exact_time, doubles_around(exact_time)) {}

RealRoot::RealRoot(const Dyadic& exact_time, TimeEnclosure doubles)
    : lo_(exact_time), hi_(exact_time), enclosure_(doubles) {}

RealRoot::RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, int sign_after_lo,
                   TimeEnclosure doubles)
    : lo_(lo), hi_(hi), sign_after_lo_(sign_after_lo), f_(f), enclosure_(doubles) {}

TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess) {
  const int sign_lo = f.sign_at(Dyadic::of(lo));
  assert(sign_lo != 0 && f.sign_at(Dyadic::of(hi)) == -sign_lo);
  return bracket_root([&f](double time) { return f.sign_at(Dyadic::of(time)); }, sign_lo, lo, hi,
                      guess);
}

bool has_root_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  const int at_zero = f.sign_at_zero(), at_one = f.sign_at_one();
  if (at_zero == 0 || at_one == 0 || at_zero != at_one) return true;
  const SignChanges changes = sign_changes_over_unit(f);
  return changes.count > 0 && !isolated_roots(square_free_part(f), f, changes, Roots::any).empty();
}

std::vector<RealRoot> roots_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  std::vector<RealRoot> roots;
  const Dyadic zero = Dyadic::of(0), one = Dyadic::of(1);
  if (f.sign_at_zero() == 0) roots.emplace_back(zero, TimeEnclosure{0, 0});
  const SignChanges changes = sign_changes_over_unit(f);
  if (changes.count == 1) {
    // Exactly one root, and a simple one: nothing to isolate, whatever roots are elsewhere.
    roots.push_back(enclosed(f, {zero, one, {0, 1}, changes.first}));
  } else if (changes.count > 1) {
    const Polynomial simple = square_free_part(f);
    for (const auto& root : isolated_roots(simple, f, changes, Roots::all)) {
      roots.push_back(enclosed(simple, root));
    }
  }
  if (f.sign_at_one() == 0) roots.emplace_back(one, TimeEnclosure{1, 1});
  return roots;
}

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

namespace {

// The signs of a polynomial just inside the ends of an open interval. If the polynomial vanishes at
// an end, its first derivative that does not vanish there gives the sign.
struct EndSigns {
  int after_lo, before_hi;
};

EndSigns end_signs(const Polynomial& q, const Dyadic& lo, const Dyadic& hi) {
  EndSigns signs{q.sign_at(lo), q.sign_at(hi)};
  int turned = -1;  // of the derivative of odd order, before an end
  for (Polynomial slope = q.derivative();
       !slope.is_zero() && (signs.after_lo == 0 || signs.before_hi == 0);
       slope = slope.derivative(), turned = -turned) {
    if (signs.after_lo == 0) signs.after_lo = slope.sign_at(lo);
    if (signs.before_hi == 0) signs.before_hi = turned * slope.sign_at(hi);
  }
  return signs;
}

// Returns the sign of q at the root -b/a of a t + b.
int sign_at_root_of_linear(const Polynomial& q, const Polynomial& linear) {
  const Integer &a = linear[1], &b = linear[0];
  return Integer(q[2] * b * b - q[1] * a * b + q[0] * a * a).sign();
}

}  // namespace

int RealRoot::sign_of(const Polynomial& q) const {
  if (is_exact() || q.degree() <= 0) return q.sign_at(lo_);
  if (q.degree() > 2) {
    const SignChanges changes = sign_changes_over(q, lo_, hi_);
    return changes.count == 0 ? changes.first : sign_beside_roots(q);
  }
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

// Gives each root of f and of q in the gap of doubles around (lo,hi) an interval of its own, or its
// exact time. The part in (lo,hi) of one of these intervals holds the root of f: there f changes
// its sign. No other root of q is in that part. So q vanishes at the root of f if and only if q,
// with its multiple roots made simple, changes its sign over the part; and if not, q has one sign
// there.
int RealRoot::sign_beside_roots(const Polynomial& q) const {
  std::vector<IsolatedRoot> roots;
  isolate_in_gap(square_free_part(f_ * q), enclosure_, Roots::all, roots);
  const auto is_before = [](const Dyadic& a, const Dyadic& b) {
    return (b + Dyadic{-a.mantissa, a.exponent}).mantissa.sign() > 0;
  };
  for (const IsolatedRoot& root : roots) {
    const Dyadic& lo = is_before(lo_, root.lo) ? root.lo : lo_;
    const Dyadic& hi = is_before(root.hi, hi_) ? root.hi : hi_;
    if (root.is_time()) {
      if (is_before(lo_, root.lo) && is_before(root.lo, hi_) && f_.sign_at(root.lo) == 0)
        return q.sign_at(root.lo);
      continue;
    }
    if (!is_before(lo, hi)) continue;
    const EndSigns of_f = end_signs(f_, lo, hi);
    if (of_f.after_lo == of_f.before_hi) continue;
    const EndSigns of_q = end_signs(square_free_part(q), lo, hi);
    return of_q.after_lo != of_q.before_hi ? 0 : end_signs(q, lo, hi).after_lo;
  }
  assert(false);
  return 0;
}

}  // namespace assay::detector
