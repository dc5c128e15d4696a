// Real numbers of any magnitude, known up to a bound: what the integers without bound are filtered
// by. Signs of sums of products of integers of thousands of bits are told here in some 0.1 us
// unless all but the last 2^-50 of their terms cancels; then integers decide.
//
// A ball is a pair of doubles and an exponent: the number is within radius 2^exponent of
// middle 2^exponent. The larger of |middle| and radius is in [1,2), or both are 0 and so is the
// number. So doubles neither overflow nor lose small numbers, whatever the exponent is.
//
// Errors, with u = 2^-53. A sum or product of doubles is off by at most u times its size: 2 u are
// added to the radius for it. The radius itself is rounded, a few times for each operation, and
// what is far smaller than the rest may underflow when the pair is scaled (by 2^-1074 where the
// radius is 2^-260 or more): all of that is far below `slack`, by which each radius grows.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "detector/exact/integer.h"

namespace assay::detector {

class Ball {
 public:
  Ball() = default;  // exactly 0

  // value 2^exponent, from its two highest limbs. With the higher one t >= 1 and the lower one l,
  // both as integers, t + l 2^-64 in doubles is off by u t (0 for t below 2^53), u and u (t + 1)
  // at most, and the limbs below are worth less than 2^-64: together less than 4 u t.
  explicit Ball(const Integer& value, std::int64_t exponent = 0) {
    using Limb = boost::multiprecision::limb_type;
    static_assert(sizeof(Limb) == 8);
    if (value.is_zero()) return;
    const auto& backend = value.backend();
    const std::size_t size = backend.size();
    const Limb* limbs = backend.limbs();
    const Limb top = limbs[size - 1];
    middle_ = static_cast<double>(top);
    if (size > 1) middle_ += 0x1p-64 * static_cast<double>(limbs[size - 2]);
    constexpr Limb exact_below = Limb{1} << 53;
    if (size > 1 || top >= exact_below) radius_ = 0x1p-51 * middle_;
    if (backend.sign()) middle_ = -middle_;
    exponent_ = exponent + 64 * (static_cast<std::int64_t>(size) - 1);
    normalize();
  }

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

  // Nothing where the bound does not tell.
  std::optional<int> sign() const {
    if (middle_ > radius_) return 1;
    if (-middle_ > radius_) return -1;
    if (is_zero()) return 0;
    return std::nullopt;
  }

 private:
  static constexpr double slack = 1 + 0x1p-40;

  bool is_zero() const { return middle_ == 0 && radius_ == 0; }

  // 2^exponent, for exponents of normal doubles.
  static double power_of_two(std::int64_t exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
  }

  // Of two that are not 0, a with the greater exponent. Far below a's unit b is below 4 2^-200, as
  // its middle and its radius are below 2 of its units: it then is a part of the radius.
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
