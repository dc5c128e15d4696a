// The sign of q at a zero r of f: q is its leading coefficient times the product of t - e over its
// real zeros e, or times what is positive if it has none. So the sign is known once it is known on
// which side of r each e is. An e inside of the piece of r is before r exactly when f has the sign
// there that it has where the piece begins, and is r exactly when f is zero there.
#include "oracle/query/times/cubic_times.h"

#include <cassert>
#include <utility>

#include "oracle/query/times/quadratic_time.h"
#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

namespace {

int sign_of(const IntegerPolynomial& f, const QuadraticTime& time) { return time.sign(f); }
int sign_of(const IntegerPolynomial& f, double time) { return sign_at(f, time); }

}  // namespace

CubicTimes::CubicTimes(IntegerPolynomial f) : f_(std::move(f)) {
  assert(f_.degree() == 2 || f_.degree() == 3);
  const std::vector<IntegerPolynomial> bounds = {{{0, 1}}, derivative(f_), {{-1, 1}}};
  bounds_ = QuadraticTimes(bounds).take();
  for (const QuadraticTime& bound : bounds_) signs_.push_back(bound.sign(f_));
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (signs_[i] == 0) zeros_.push_back({i});
    if (i + 1 < bounds_.size() && signs_[i] * signs_[i + 1] < 0) zeros_.push_back({i, true});
  }
}

int CubicTimes::size() const { return static_cast<int>(zeros_.size()); }

template <class Time>
int CubicTimes::compare(const Zero& zero, const Time& other) const {
  const int at_begin = bounds_[zero.bound].compare(other);
  if (!zero.inside || at_begin >= 0) return zero.inside ? 1 : at_begin;
  if (bounds_[zero.bound + 1].compare(other) <= 0) return -1;
  return sign_of(f_, other) * signs_[zero.bound];
}

int CubicTimes::sign(const IntegerPolynomial& q, int i) const {
  assert(q.degree() <= 2);
  if (q.is_zero()) return 0;
  if (q.degree() == 0) return sgn(q.c[0]);
  const Zero& zero = zeros_[i];
  if (!zero.inside) return bounds_[zero.bound].sign(q);
  if (surely_no_zero_in_unit(q)) return sgn(q.c[0]);
  std::vector<QuadraticTime> others;
  QuadraticTime::append_zeros(q, others);
  int sign = sgn(q.c.back());
  for (const QuadraticTime& other : others) sign *= compare(zero, other);
  const bool squared = q.degree() == 2 && others.size() == 1;
  return squared ? sign * compare(zero, others[0]) : sign;
}

detector::TimeEnclosure CubicTimes::enclosure(int i) const {
  const Zero& zero = zeros_[i];
  if (!zero.inside) return bounds_[zero.bound].enclosure();
  const double s = bounds_[zero.bound].enclosure().hi, e = bounds_[zero.bound + 1].enclosure().lo;
  if (s < e && sign_at(f_, s) * sign_at(f_, e) < 0) return simple_zero_time(f_, s, e);
  return enclose_time(s, 0, 1, [&](double t) { return compare(zero, t); });
}

}  // namespace assay::oracle
