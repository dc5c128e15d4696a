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
// Its value at t = m 2^-e <= 1, times 2^(3e), is a sum of four terms, each below 2^(3c + 10 + 3e),
// so it is below 2^(3c + 12 + 3e). As 3c <= 192 W - 24, with e <= 64 it fits 3 W + 3 limbs, which
// are 192 W + 192 bits, and with e <= 128 it fits 3 W + 6 limbs.
#pragma once

#include "detector/bernstein/bernstein.h"
#include "detector/contact/contact_pieces.h"
#include "detector/contact/fixed_products.h"
#include "detector/exact/polynomial.h"
#include "detector/exact/root_bracket.h"

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
  // b: B0..B3. bits: those of a coordinate; they only scale guesses.
  FixedRoot(const FixedCubic<FixedInteger<3 * W>>& b, int bits) : bits_(bits) {
    const auto b0_3 = b[0] + b[0] + b[0];
    c_ = {b[0], b[1] - b0_3, b[2] - (b[1] + b[1]) + b0_3, b[3] - b[2] + b[1] - b[0]};
  }

  // As bracket_root: the one root in (lo, hi), where sign_lo is the sign before it.
  TimeEnclosure bracket(int sign_lo, double lo, double hi, double guess) const {
    return bracket_root([this](double t) { return sign_at(t); }, sign_lo, lo, hi,
                        sharpened(guess, lo, hi));
  }

  // The exact sign of the cubic at a double in [0,1].
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

  // Improves the guess by one Newton step with the exact value. Mostly it is then off by less than
  // the last place of a double.
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

  // The sign at times so near 0 that their powers do not fit into integers of fixed width.
  int unbounded_sign_at(double time) const {
    Polynomial f;
    const Polynomial t = Polynomial::linear(0, 1);
    for (std::size_t i = 4; i-- > 0;) f = f * t + Polynomial::constant(integer_of(c_[i]));
    return f.sign_at(Dyadic::of(time));
  }

  int bits_;
  FixedCubic<Coefficient> c_;
};

}  // namespace assay::detector
