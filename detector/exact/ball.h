// Real numbers of any magnitude, known up to a bound. Balls are the filter before the integers
// without bound: they find the sign of a sum of products of integers of thousands of bits in some
// 0.1 us, unless the terms cancel to 2^-50 of their size or less. In that case integers decide.
//
// A ball is a pair of doubles and an exponent. The number is off by at most radius * 2^exponent
// from middle * 2^exponent. Either the larger of |middle| and radius is in [1,2), or both are 0 and
// the number is 0. So the doubles neither overflow nor lose small numbers, for any exponent.
//
// Errors, with u = 2^-53. A sum or product of doubles is off by at most u times its size; the
// radius grows by 2 u of that size to cover it. The radius itself is rounded a few times in each
// operation. When middle and radius are scaled, the one that is far smaller may underflow (by
// 2^-1074, while the radius is 2^-260 or more). Each radius is multiplied by `slack`, which more
// than covers both.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>

#include "detector/exact/fixed_integer.h"
#include "detector/exact/polynomial.h"

namespace assay::detector {

class Ball {
 public:
  Ball() = default;  // exactly 0

  // The ball around value * 2^exponent, from the two highest limbs of `value`. Let t >= 1 be the
  // highest limb and l the next lower limb, both as integers. Computed in doubles, t + l 2^-64 has
  // three errors: at most u t from t (0 for t below 2^53), at most u from l, and at most u (t + 1)
  // from the sum. All lower limbs together add less than 2^-64. Together that is less than 4 u t.
  explicit Ball(const Integer& value, std::int64_t exponent = 0) {
    using Limb = boost::multiprecision::limb_type;
    static_assert(sizeof(Limb) == 8);
    if (value.is_zero()) return;
    const auto& backend = value.backend();
    const std::size_t size = backend.size();
    take_limbs(backend.limbs(), size);
    if (backend.sign()) middle_ = -middle_;
    exponent_ += exponent;
  }
  // The ball around an integer of fixed width.
  template <std::size_t limbs>
  explicit Ball(const FixedInteger<limbs>& value) {
    const FixedInteger<limbs> positive = value.negative() ? -value : value;
    std::uint64_t of_value[limbs];
    std::size_t size = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      of_value[i] = positive.limb(i);
      if (of_value[i] != 0) size = i + 1;
    }
    if (size == 0) return;
    take_limbs(of_value, size);
    if (value.negative()) middle_ = -middle_;
  }

  // Returns the ball that contains only `value`. REQUIRES that `value` is finite.
  static Ball of(double value) {
    Ball ball;
    int exponent = 0;
    ball.middle_ = 2 * std::frexp(value, &exponent);
    ball.exponent_ = value == 0 ? 0 : exponent - 1;
    return ball;
  }

  // Returns the ball that holds all numbers between two doubles. REQUIRES 0 <= lo < hi, and hi - lo
  // in the range of normal doubles. The middle and half of the width are each rounded once. The
  // slack and the term 2^-52 hi of the radius cover these roundings.
  static Ball between(double lo, double hi) {
    assert(0 <= lo && lo < hi && hi - lo >= 0x1p-1000);
    Ball ball;
    ball.middle_ = lo / 2 + hi / 2;
    ball.radius_ = slack * ((hi - lo) / 2 + 0x1p-52 * hi);
    ball.normalize();
    return ball;
  }

  Ball operator-() const {
    Ball negated = *this;
    negated.middle_ = -middle_;
    return negated;
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + (-b); }

  friend Ball operator+(const Ball& a, const Ball& b) {
    if (a.is_zero()) return b;
    if (b.is_zero()) return a;
    return a.exponent_ < b.exponent_ ? sum_of(b, a) : sum_of(a, b);
  }

  // (x + e)(y + f) = x y + x f + e y + e f, where x and y are the middles.
  friend Ball operator*(const Ball& a, const Ball& b) {
    Ball product;
    if (a.is_zero() || b.is_zero()) return product;
    const double x = std::abs(a.middle_), y = std::abs(b.middle_);
    product.middle_ = a.middle_ * b.middle_;
    product.radius_ =
        slack * (x * b.radius_ + a.radius_ * y + a.radius_ * b.radius_ + 0x1p-52 * x * y);
    product.exponent_ = a.exponent_ + b.exponent_;
    product.normalize();
    return product;
  }

  // Returns the sign of the number, or nullopt if the ball contains 0 and other numbers.
  std::optional<int> sign() const {
    if (middle_ > radius_) return 1;
    if (-middle_ > radius_) return -1;
    if (is_zero()) return 0;
    return std::nullopt;
  }

 private:
  // Sets this to the ball around the integer with these limbs. REQUIRES that the last limb is not
  // 0.
  template <class Limb>
  void take_limbs(const Limb* limbs, std::size_t size) {
    const Limb top = limbs[size - 1];
    middle_ = static_cast<double>(top);
    if (size > 1) middle_ += 0x1p-64 * static_cast<double>(limbs[size - 2]);
    constexpr Limb exact_below = Limb{1} << 53;
    if (size > 1 || top >= exact_below) radius_ = 0x1p-51 * middle_;
    exponent_ = 64 * (static_cast<std::int64_t>(size) - 1);
    normalize();
  }

  static constexpr double slack = 1 + 0x1p-40;

  bool is_zero() const { return middle_ == 0 && radius_ == 0; }

  // Returns 2^exponent. REQUIRES an exponent of normal doubles.
  static double power_of_two(std::int64_t exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
  }

  // Returns a + b. REQUIRES that neither is 0, and that the exponent of b is not the greater one.
  // Let the unit of a ball be 2^exponent. The middle and the radius of b are each below 2 units of
  // b. If the unit of b is less than 2^-200 units of a, then b is below 4 2^-200 units of a, and is
  // added only to the radius.
  static Ball sum_of(const Ball& a, const Ball& b) {
    constexpr std::int64_t far = 200;
    const std::int64_t shift = a.exponent_ - b.exponent_;
    Ball sum = a;
    if (shift > far) {
      sum.radius_ = slack * a.radius_ + 0x1p-197;
    } else {
      const double scale = power_of_two(-shift);
      sum.middle_ = a.middle_ + scale * b.middle_;
      sum.radius_ = slack * (a.radius_ + scale * b.radius_ + 0x1p-52 * std::abs(sum.middle_));
    }
    sum.normalize();
    return sum;
  }

  void normalize() {
    const double larger = std::max(std::abs(middle_), radius_);
    if (larger == 0) {
      exponent_ = 0;
      return;
    }
    const auto e = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(larger) >> 52) - 1023;
    if (e == 0) return;
    const double scale = power_of_two(-e);
    middle_ *= scale;
    radius_ *= scale;
    exponent_ += e;
  }

  double middle_ = 0, radius_ = 0;
  std::int64_t exponent_ = 0;
};

}  // namespace assay::detector
