#include "oracle/query/times/times.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace assay::oracle {

namespace {

constexpr int greatest_degree = 6;

}  // namespace

double guess_zero(const IntegerPolynomial& f, double s, double e, int sign_at_s) {
  std::array<double, greatest_degree + 1> c{};
  long greatest = std::numeric_limits<long>::min();
  for (const Integer& x : f.c) {
    long exponent = 0;
    mpz_get_d_2exp(&exponent, x.get_mpz_t());
    if (sgn(x) != 0) greatest = std::max(greatest, exponent);
  }
  for (std::size_t i = 0; i < f.c.size(); ++i) {
    long exponent = 0;
    const double fraction = mpz_get_d_2exp(&exponent, f.c[i].get_mpz_t());
    constexpr long vanishing_exponent = -2000;
    c[i] =
        std::ldexp(fraction, static_cast<int>(std::max(exponent - greatest, vanishing_exponent)));
  }
  double lo = s, hi = e, t = 0.5 * (s + e);
  constexpr int most_steps = 100;
  for (int step = 0; step < most_steps; ++step) {
    double value = 0, slope = 0;
    for (int i = f.degree(); i >= 0; --i) {
      slope = slope * t + value;
      value = value * t + c[i];
    }
    if (value == 0) break;
    ((value > 0) == (sign_at_s > 0) ? lo : hi) = t;
    const double newton = t - value / slope;
    const double next = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
    if (next == t || !(lo < hi)) break;
    t = next;
  }
  return t;
}

detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e) {
  const int sign_at_s = sign_at(f, s);
  assert(f.degree() <= greatest_degree && sign_at_s * sign_at(f, e) < 0);
  return enclose_time(guess_zero(f, s, e, sign_at_s), s, e,
                      [&](double t) { return sign_at(f, t) * sign_at_s; });
}

// How signs are found. Let p = a t^2 + b t + c with a > 0 and d = b^2 - 4ac > 0, let r be the zero
// (-b + s sqrt(d)) / 2a with s = -1 or 1, and q = q2 t^2 + q1 t + q0.
//
// 1. At r, a q = a q - q2 p = u t + v, where u = a q1 - q2 b and v = a q0 - q2 c. If q has a higher
//    degree, several steps of this kind make it linear.
// 2. 2a (u r + v) = A + s u sqrt(d), where A = 2av - bu. If the two terms do not have opposite
//    signs, theirs is the sign. Else it is the sign of A times that of
//    A^2 - u^2 d = 4a (a v^2 - b u v + c u^2); the bracket is the resultant of p and u t + v.
//
// If a = 0 and b > 0, then r = -c/b and b^n q(r) is found by Horner's rule.
//
// r > t exactly when r - t, a linear polynomial at r, is positive. The zeros of two polynomials are
// compared by the signs of one polynomial and of its derivative at the zero of the other: they tell
// whether that zero lies before, between or after the two zeros of the first polynomial.

namespace {

// A number m 2^e of any magnitude, rounded. For guesses only, so no error bound is needed.
struct Rounded {
  double m = 0;
  long e = 0;
};

Rounded rounded(const Integer& x) {
  Rounded r;
  r.m = mpz_get_d_2exp(&r.e, x.get_mpz_t());
  return r;
}

Rounded square_root(Rounded x) {
  if (x.e % 2 != 0) x = {2 * x.m, x.e - 1};
  return {std::sqrt(x.m), x.e / 2};
}

double scaled(double x, long exponent) {
  constexpr long most = 4000;  // far beyond all doubles
  return std::ldexp(x, static_cast<int>(std::clamp(exponent, -most, most)));
}

Rounded sum(const Rounded& x, const Rounded& y) {
  const long e = x.m == 0 ? y.e : (y.m == 0 ? x.e : std::max(x.e, y.e));
  return {scaled(x.m, x.e - e) + scaled(y.m, y.e - e), e};
}

double quotient(const Rounded& x, const Rounded& y) { return scaled(x.m / y.m, x.e - y.e); }

}  // namespace

QuadraticTime::QuadraticTime(Integer a, Integer b, Integer c, Zero zero)
    : a_(std::move(a)), b_(std::move(b)), c_(std::move(c)), zero_(zero) {}

void QuadraticTime::append_zeros(const IntegerPolynomial& p, std::vector<QuadraticTime>& to) {
  assert(p.degree() == 1 || p.degree() == 2);
  const bool negate = sgn(p.c.back()) < 0;
  auto coefficient = [&](int i) { return negate ? Integer(-p.c[i]) : p.c[i]; };
  Integer c = coefficient(0), b = coefficient(1);
  if (p.degree() == 1) {
    to.push_back(QuadraticTime(0, std::move(b), std::move(c), Zero::only));
    return;
  }
  Integer a = coefficient(2);
  Integer discriminant = b * b;
  discriminant -= (a * c) << 2;
  if (sgn(discriminant) < 0) return;
  if (sgn(discriminant) == 0) {  // p = a (t + b/2a)^2
    to.push_back(QuadraticTime(0, a << 1, std::move(b), Zero::only));
    return;
  }
  to.push_back(QuadraticTime(a, b, c, Zero::lesser));
  to.push_back(QuadraticTime(std::move(a), std::move(b), std::move(c), Zero::greater));
}

int QuadraticTime::sign_of_linear(const Integer& u, const Integer& v) const {
  if (zero_ == Zero::only) return sgn(Integer(v * b_ - u * c_));
  if (sgn(u) == 0) return sgn(v);
  const Integer av = a_ * v, bu = b_ * u;
  const int of_root = static_cast<int>(zero_) * sgn(u);
  const int of_rational = sgn(Integer((av << 1) - bu));
  if (of_rational * of_root >= 0) return of_root;
  return of_rational * sgn(Integer((av - bu) * v + c_ * u * u));
}

int QuadraticTime::sign(const IntegerPolynomial& q) const {
  if (q.degree() <= 0) return q.is_zero() ? 0 : sgn(q.c[0]);
  if (zero_ == Zero::only) {
    Integer value = q.c.back(), power = b_;
    for (int i = q.degree() - 1; i >= 0; --i, power *= b_) value = q.c[i] * power - value * c_;
    return sgn(value);
  }
  if (q.degree() == 1) return sign_of_linear(q.c[1], q.c[0]);
  if (q.degree() == 2) {
    return sign_of_linear(a_ * q.c[1] - q.c[2] * b_, a_ * q.c[0] - q.c[2] * c_);
  }
  IntegerPolynomial rest = q;
  while (rest.degree() > 1) {
    const Integer top = std::move(rest.c.back());
    rest.c.pop_back();
    for (Integer& x : rest.c) x *= a_;
    rest.c[rest.c.size() - 1] -= top * b_;
    rest.c[rest.c.size() - 2] -= top * c_;
    while (!rest.is_zero() && rest.c.back() == 0) rest.c.pop_back();
  }
  return sign(rest);
}

int QuadraticTime::compare(const QuadraticTime& other) const {
  if (other.zero_ == Zero::only) return sign_of_linear(other.b_, other.c_);
  const int value = sign(IntegerPolynomial{{other.c_, other.b_, other.a_}});
  if (value < 0) return -static_cast<int>(other.zero_);  // between the two zeros
  const int slope = sign_of_linear(other.a_ << 1, other.b_);
  // At or beyond the zero on the side that the slope tells; the other zero lies farther.
  return slope != static_cast<int>(other.zero_) || value > 0 ? slope : 0;
}

int QuadraticTime::compare(double t) const {
  if (t == 0) return sign_of_linear(1, 0);
  // r - t = (2^k r - m) / 2^k with an integer m; no exponent is positive, because t <= 1.
  int exponent = 0;
  const double fraction = std::frexp(t, &exponent);
  constexpr int digits = std::numeric_limits<double>::digits;
  return sign_of_linear(Integer(1) << static_cast<mp_bitcnt_t>(digits - exponent),
                        Integer(-std::ldexp(fraction, digits)));
}

double QuadraticTime::guess() const {
  const Rounded a = rounded(a_), b = rounded(b_), c = rounded(c_);
  if (zero_ == Zero::only) return quotient({-c.m, c.e}, b);
  Rounded root = square_root(rounded(b_ * b_ - ((a_ * c_) << 2)));
  root.m *= static_cast<double>(zero_);
  // Takes the one of (-b + root) / 2a and 2c / (-b - root) that has no cancellation.
  const bool alike = (root.m < 0) == (b.m > 0) || b.m == 0;
  if (alike) return quotient(sum({-b.m, b.e}, root), {a.m, a.e + 1});
  return quotient({c.m, c.e + 1}, sum({-b.m, b.e}, {-root.m, root.e}));
}

detector::TimeEnclosure QuadraticTime::enclosure() const {
  return enclose_time(guess(), 0, 1, [this](double t) { return compare(t); });
}

QuadraticTimes::QuadraticTimes(std::span<const IntegerPolynomial> polynomials) {
  const IntegerPolynomial from_start = {{0, 1}}, from_end = {{-1, 1}};
  std::vector<QuadraticTime> zeros;
  for (const IntegerPolynomial& p : polynomials) {
    assert(!p.is_zero());
    if (p.degree() == 0 || surely_no_zero_in_unit(p)) continue;
    zeros.clear();
    QuadraticTime::append_zeros(p, zeros);
    for (QuadraticTime& zero : zeros) {
      if (zero.sign(from_start) >= 0 && zero.sign(from_end) <= 0) times_.push_back(std::move(zero));
    }
  }
  std::sort(times_.begin(), times_.end(),
            [](const auto& a, const auto& b) { return a.compare(b) < 0; });
  times_.erase(std::unique(times_.begin(), times_.end(),
                           [](const auto& a, const auto& b) { return a.compare(b) == 0; }),
               times_.end());
}

// The sign of q at a zero r of f. q is its leading coefficient times the product of t - e over its
// real zeros e; if it has none, times a positive function. So the sign follows from the side of r
// on which each e lies. An e inside of the piece of r is before r exactly when f(e) has the sign of
// f at the start of the piece, and is r exactly when f(e) = 0.
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
