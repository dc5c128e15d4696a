// Finds the time at which the coplanarity cubic changes sign, from its coefficients in integers of
// fixed width.
//
// With B0..B3 and c of fixed_products.h the cubic is c0 + c1 t + c2 t^2 + c3 t^3:
//
//   quantity                 | below, in size     | bits
//   c0 = B0                  |  3 * 2^(3c + 4)    | 3c + 6
//   c1 = B1 - 3 B0           | 18 * 2^(3c + 4)    | 3c + 9
//   c2 = B2 - 2 B1 + 3 B0    | 36 * 2^(3c + 4)    | 3c + 10
//   c3 = B3 - B2 + B1 - B0   | 24 * 2^(3c + 4)    | 3c + 9
//
// The value of the cubic at t = m 2^-e <= 1, times 2^(3e), is a sum of four terms, each below 2^(3c
// + 10 + 3e), so it is below 2^(3c + 12 + 3e). Because 3c <= 192 W - 24, it fits into 3 W + 3 limbs
// (192 W + 192 bits) if e <= 64, and into 3 W + 6 limbs if e <= 128.
#pragma once

#include "detector/contact/contact_pieces.h"
#include "detector/contact/fixed_products.h"
#include "detector/exact/ball.h"
#include "detector/exact/bernstein.h"
#include "detector/exact/polynomial.h"
#include "detector/exact/root_isolation.h"

namespace assay::detector {

template <std::size_t limbs>
Integer integer_of(const FixedInteger<limbs>& value) {
  const auto size = value.negative() ? -value : value;
  Integer out = 0;
  for (std::size_t i = limbs; i-- > 0;) out = (out << 64) + size.limb(i);
  return value.negative() ? -out : out;
}

template <std::size_t W>
class FixedRoot {
 public:
  // `b` is B0..B3, and `bits` is the number of bits of a coordinate, which only scales guesses.
  FixedRoot(const FixedCubic<FixedInteger<3 * W>>& b, int bits) : bits_(bits) {
    const auto b0_3 = b[0] + b[0] + b[0];
    c_ = {b[0], b[1] - b0_3, b[2] - (b[1] + b[1]) + b0_3, b[3] - b[2] + b[1] - b[0]};
  }

  // Encloses the one root in (lo, hi) by bracket_root; sign_lo is the sign before the root.
  TimeEnclosure bracket(int sign_lo, double lo, double hi, double guess) const {
    return bracket_root([this](double t) { return sign_at(t); }, sign_lo, lo, hi,
                        sharpened(guess, lo, hi));
  }

  // Returns the exact sign of the cubic at a double in [0,1].
  int sign_at(double time) const {
    const Binary t = binary_of(time);
    return -t.exponent <= 64    ? scaled_value_at<3 * W + 3>(t).sign()
           : -t.exponent <= 128 ? scaled_value_at<3 * W + 6>(t).sign()
                                : unbounded_sign_at(time);
  }

 private:
  // Each of c0..c3 is below 2^(3c + 10) in size.
  using Coefficient = FixedInteger<3 * W>;

  template <std::size_t limbs>
  FixedInteger<limbs> scaled_value_at(const Binary& t) const {
    using Value = FixedInteger<limbs>;
    const auto m = static_cast<std::uint64_t>(t.mantissa);
    const auto shift = static_cast<unsigned>(-t.exponent);
    Value value(c_[3]);
    for (unsigned i = 1; i <= 3; ++i) {
      value = value.times(m) + Value(c_[3 - i]).shifted(i * shift);
    }
    return value;
  }

  // Improves the guess by one Newton step with the exact value. The result is mostly off by less
  // than the last place of a double.
  double sharpened(double guess, double lo, double hi) const {
    if (!(guess > lo && guess < hi)) return guess;
    const Binary t = binary_of(guess);
    if (-t.exponent > 64) return guess;
    const int scale = 3 * bits_;
    const double value = scaled_value_at<3 * W + 3>(t).approximate(scale - 3 * t.exponent);
    const auto c = [&](std::size_t i) { return c_[i].approximate(scale); };
    const double slope = (3 * c(3) * guess + 2 * c(2)) * guess + c(1);
    const double next = guess - value / slope;
    return next > lo && next < hi ? next : guess;
  }

  // Returns the sign at times so near 0 that their powers do not fit into integers of fixed width.
  int unbounded_sign_at(double time) const {
    Polynomial f;
    const Polynomial t = Polynomial::linear(0, 1);
    for (std::size_t i = 4; i-- > 0;) f = f * t + Polynomial::constant(integer_of(c_[i]));
    return f.sign_at(Dyadic::of(time));
  }

  int bits_;
  FixedCubic<Coefficient> c_;
};

// Returns the sign of a quadratic Q at the root p of a quadratic L in (0,1), both in Bernstein
// coefficients. REQUIRES that L has exactly one root in (0,1), and the sign l_before before that
// root.
//
// With L = l2 s^2 + l1 s + l0, l2 not 0, l2 Q = q2 L + R, R = a s + b. So at p, Q has the sign of R
// if l2 > 0, and the opposite sign if l2 < 0. If R vanishes at -b/a in (0,1), the sign of L at -b/a
// tells the order of -b/a and p (see SignAtRoot). If l2 = 0, Q is computed at p = -l0/l1. With c of
// fixed_products.h:
//
//   quantity                          | below, in size            | bits
//   q0..q2, l0..l2: by powers of s    | 4 * 2^(2c + 14)           | 2c + 16
//   a, b                              | 2 * 2^(4c + 32)           | 4c + 33
//   a^2 L(-b/a)                       | 3 * 2^(10c + 82)          | 10c + 84
//   l1^2 Q(-l0/l1)                    | 3 * 2^(6c + 48)           | 6c + 50
//
// Each quantity below the first row is a sum of products of q0..q2 and l0..l2, which have 2 W + 1
// limbs. A product has as many limbs as its factors together, so all of these fit.
template <std::size_t W>
int sign_at_root(const FixedQuadratic<FixedInteger<2 * W>>& quadratic,
                 const FixedQuadratic<FixedInteger<2 * W>>& other, int l_before) {
  using Power = FixedInteger<2 * W + 1>;
  const auto powers = [](const FixedQuadratic<FixedInteger<2 * W>>& bernstein) {
    const Power b0(bernstein[0]), d0 = Power(bernstein[1]) - b0;
    return std::array{b0, d0 + d0, Power(bernstein[2]) - Power(bernstein[1]) - d0};
  };
  const auto q = powers(quadratic), l = powers(other);
  if (l[2].is_zero())
    return (q[2] * (l[0] * l[0]) - q[1] * (l[0] * l[1]) + q[0] * (l[1] * l[1])).sign();
  const auto a = l[2] * q[1] - q[2] * l[1], b = l[2] * q[0] - q[2] * l[0];
  const int at_0 = b.sign(), at_1 = (a + b).sign();
  int of_remainder = at_0 != 0 ? at_0 : at_1;
  if (at_0 * at_1 < 0) {
    const int there = (l[2] * (b * b) - l[1] * (a * b) + l[0] * (a * a)).sign();
    of_remainder = there == 0 ? 0 : there == l_before ? at_1 : at_0;
  }
  return l[2].negative() ? -of_remainder : of_remainder;
}

// Computes the sign of a quadratic L at the root r of a cubic F in (0,1). REQUIRES that F and L
// each have exactly one root in (0,1). The sign is found by a resultant: no interval has to be made
// small, and common roots are no special case.
//
// Let p be the root of L. On (0,1) F has the sign f before r and -f after r, and L has the sign l
// before p and -l after p. So F(p) tells the order of r and p:
//
//   F(p) = 0      r = p, and L(r) = 0
//   F(p) has f    p < r, and L(r) has -l
//   F(p) has -f   r < p, and L(r) has l
//
// F(p) is found by division. With L = l2 s^2 + l1 s + l0, l2 not 0, there are a and b with
//
//   l2^2 F = (...) L + R,   R = a s + b,
//
// so F(p) has the sign of R(p). If R has the same sign at 0 and 1, R(p) has that sign too. Else R
// vanishes at q = -b/a in (0,1), and L(q) tells the order of p and q in the same way:
//
//   a^2 L(q) = l2 b^2 - l1 a b + l0 a^2.
//
// If l2 = 0 the root is p = -l0/l1, and F(p) is computed directly.
//
// Widths. As in fixed_products.h W is the number of limbs of a coordinate and c its bits, at most
// 64 W - 8. After 4 halvings the Bernstein coefficients of F have 3c + 20 bits, those of L have
// 2c + 14.
//
//   quantity                          | below, in size            | bits       | limbs
//   f0..f3: F by powers of s          | 12 * 2^(3c + 20)          | 3c + 24    | 3 W + 1
//   l0..l2: L by powers of s          | 4 * 2^(2c + 14)           | 2c + 16    | 2 W + 1
//   first step of the division        | 2 * 2^(5c + 40)           | 5c + 41    | 5 W + 1
//   a, b: the second step             | 2 * 2^(7c + 57)           | 7c + 58    | 7 W + 1
//   a^2 L(q)                          | 3 * 2^(16c + 132)         | 16c + 134  | 16 W + 3
//   l1^3 F(-l0/l1)                    | 4 * 2^(9c + 72)           | 9c + 74    | 9 W + 4
//
// Doubles come first. Their errors, in units of u = 2^-53 of the quantity itself, or of S, the sum
// of the sizes of all terms:
//
//   quantity                      | operations                         | error in u
//   a coefficient as a double     | two limbs rounded, one sum         | less than 4
//   the quotient p = -l0/l1       | a division                         | 4 + 4 + 1 = 9
//   a term                        | a product of at most four factors  | at most 4 (9 + 1) = 40
//   a sum of seven terms at most  | six sums                           | 40 + 6 = 46 S
//
// The code uses the bound 128 u S. If S is so small that a term may have lost bits by underflow,
// doubles decide nothing.
template <std::size_t W>
class SignAtRoot {
 public:
  using Minor = typename FixedProducts<W>::Minor;
  using Triple = typename FixedProducts<W>::Triple;

  // f: the Bernstein coefficients of F over (0,1). sign_before: the sign of F before its root.
  // bits: the number of bits of a coordinate.
  SignAtRoot(const FixedCubic<Triple>& f, int sign_before, int bits)
      : f_before_(sign_before), bits_(bits) {
    const FixedCubic<F> b = {F(f[0]), F(f[1]), F(f[2]), F(f[3])};
    const F d1 = b[1] - b[0], d2 = b[2] - b[1];
    f_ = {b[0], d1 + d1 + d1, (d2 - d1) + (d2 - d1) + (d2 - d1), b[3] - b[0] - (d2 + d2 + d2)};
    for (std::size_t i = 0; i < 4; ++i) near_f_[i] = f_[i].approximate(3 * bits_);
  }

  // Returns the sign that the quadratic L with these Bernstein coefficients has at the root of F.
  // l_before: the sign of L before its own root.
  int of(const FixedQuadratic<Minor>& quadratic, int l_before) const {
    const FixedQuadratic<L> b = {L(quadratic[0]), L(quadratic[1]), L(quadratic[2])};
    const L d0 = b[1] - b[0], d1 = b[2] - b[1];
    const int order = sign_at_root_of({b[0], d0 + d0, d1 - d0}, l_before);
    return order == 0 ? 0 : order == f_before_ ? -l_before : l_before;
  }

 private:
  // For a smaller W, products of integers take no longer than balls.
  static constexpr std::size_t worth_balls = 3;
  using F = FixedInteger<3 * W + 1>;
  using L = FixedInteger<2 * W + 1>;
  using Step1 = FixedInteger<5 * W + 1>;
  using Step2 = FixedInteger<7 * W + 1>;
  using Value = FixedInteger<16 * W + 3>;

  // Returns the sign of F at the root p of L.
  int sign_at_root_of(const FixedQuadratic<L>& l, int l_before) const {
    const Quadratic near_l = {l[0].approximate(2 * bits_), l[1].approximate(2 * bits_),
                              l[2].approximate(2 * bits_)};
    const bool is_linear = l[2].is_zero();
    if (const int sure = is_linear ? sure_at_quotient(near_l) : sure_remainder(near_l)) return sure;
    if (is_linear) return sign_at_quotient(l[0], l[1]);
    if constexpr (W >= worth_balls) {
      if (const auto sure = sign_by_balls(l, l_before)) return *sure;
    }
    const Step1 d2(l[2] * f_[2] - l[1] * f_[3]), d1(l[2] * f_[1] - l[0] * f_[3]), d0(l[2] * f_[0]);
    const Step2 a(l[2] * d1 - l[1] * d2), b(l[2] * d0 - l[0] * d2);
    const int at_0 = b.sign(), at_1 = (a + b).sign();
    if (at_0 * at_1 >= 0) return at_0 != 0 ? at_0 : at_1;
    const Value at_q(l[2] * (b * b) - l[1] * (a * b) + l[0] * (a * a));
    const int sign = at_q.sign();
    return sign == 0 ? 0 : sign == l_before ? at_1 : at_0;
  }

  // Does the same in balls, which know the size of each term, whatever the exponents of the
  // coordinates are. Returns nullopt if balls cannot tell.
  std::optional<int> sign_by_balls(const FixedQuadratic<L>& quadratic, int l_before) const {
    const std::array l = {Ball(quadratic[0]), Ball(quadratic[1]), Ball(quadratic[2])};
    const std::array f = {Ball(f_[0]), Ball(f_[1]), Ball(f_[2]), Ball(f_[3])};
    const Ball d2 = l[2] * f[2] - l[1] * f[3], d1 = l[2] * f[1] - l[0] * f[3], d0 = l[2] * f[0];
    const Ball a = l[2] * d1 - l[1] * d2, b = l[2] * d0 - l[0] * d2;
    const auto at_0 = b.sign(), at_1 = (a + b).sign();
    if (!at_0 || !at_1) return std::nullopt;
    if (*at_0 * *at_1 >= 0) return *at_0 != 0 ? at_0 : at_1;
    const auto at_q = (l[2] * (b * b) - l[1] * (a * b) + l[0] * (a * a)).sign();
    if (!at_q) return std::nullopt;
    return *at_q == 0 ? 0 : *at_q == l_before ? *at_1 : *at_0;
  }

  // l1^3 F(-l0/l1) = ((f3 p + f2 l1) p + f1 l1^2) p + f0 l1^3, p = -l0.
  int sign_at_quotient(const L& l0, const L& l1) const {
    const L p = -l0;
    const auto l1_2 = l1 * l1;
    const auto quadratic = (f_[3] * p + f_[2] * l1) * p + f_[1] * l1_2;
    const int sign = (quadratic * p + f_[0] * (l1_2 * l1)).sign();
    return l1.negative() ? -sign : sign;
  }

  static int sure(double value, double size) {
    constexpr double relative_error = 128 * unit_roundoff, least_size = 0x1p-800;
    return size > least_size ? sign_beyond(value, relative_error * size) : 0;
  }

  int sure_at_quotient(const Quadratic& l) const {
    const double p = -l[0] / l[1];
    const double terms[] = {near_f_[0], near_f_[1] * p, near_f_[2] * p * p, near_f_[3] * p * p * p};
    return sure(terms[0] + terms[1] + terms[2] + terms[3],
                std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]) + std::abs(terms[3]));
  }

  // Returns the sign of the remainder R if it surely has one sign on (0,1), else 0.
  int sure_remainder(const Quadratic& l) const {
    const Cubic& f = near_f_;
    const double a[] = {l[2] * l[2] * f[1], -l[2] * l[0] * f[3], -l[1] * l[2] * f[2],
                        l[1] * l[1] * f[3]};
    const double b[] = {l[2] * l[2] * f[0], -l[0] * l[2] * f[2], l[0] * l[1] * f[3]};
    double at_0 = 0, size_0 = 0, slope = 0, size = 0;
    for (const double term : b) at_0 += term, size_0 += std::abs(term);
    for (const double term : a) slope += term, size += std::abs(term);
    const int sign = sure(at_0, size_0);
    return sign != 0 && sure(at_0 + slope, size_0 + size) == sign ? sign : 0;
  }

  int f_before_, bits_;
  FixedCubic<F> f_;
  Cubic near_f_;  // f_ times 2^(-3 bits), in doubles
};

}  // namespace assay::detector
