// The coordinates of an elementary query as integers. Each axis is multiplied by a power of two of
// its own. This is an affine map, so contacts and their times stay the same, and the integers are
// as short as they can be.
#pragma once

#include <bit>
#include <climits>

#include "detector/contact/four_points.h"
#include "detector/exact/fixed_integer.h"

namespace assay::detector {

class QueryIntegers {
 public:
  explicit QueryIntegers(const FourPoints& query) {
    for (std::size_t k = 0; k < 3; ++k) {
      int least = INT_MAX, beyond = INT_MIN;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t end = 0; end < 2; ++end) {
          Coordinate& c = coordinates_[i][end][k];
          c = split(end == 0 ? query.points[i].t0[k] : query.points[i].t1[k]);
          if (c.mantissa == 0) continue;
          least = std::min(least, c.exponent + std::countr_zero(c.mantissa));
          beyond = std::max(beyond, c.exponent + static_cast<int>(std::bit_width(c.mantissa)));
        }
      }
      least_[k] = least;
      if (beyond > least) bits_ = std::max(bits_, beyond - least);
    }
  }

  // Every integer is below 2^bits() in size.
  int bits() const { return bits_; }

  // The coordinate of point i along axis k, at t=0 (end 0) or t=1 (end 1). REQUIRES bits() < 64
  // limbs.
  template <std::size_t limbs>
  FixedInteger<limbs> at(std::size_t i, std::size_t end, std::size_t k) const {
    const Coordinate& c = coordinates_[i][end][k];
    FixedInteger<limbs> value;
    if (c.mantissa == 0) return value;
    const int shift = c.exponent - least_[k];
    if (shift <= 0) {
      value.limb(0) = c.mantissa >> -shift;
    } else {
      const auto whole = static_cast<std::size_t>(shift) / 64;
      const auto part = static_cast<unsigned>(shift) % 64;
      value.limb(whole) = c.mantissa << part;
      if (part > 0 && whole + 1 < limbs) value.limb(whole + 1) = c.mantissa >> (64 - part);
    }
    return c.negative ? -value : value;
  }

 private:
  struct Coordinate {
    std::uint64_t mantissa;
    int exponent;
    bool negative;
  };

  // A finite double as its sign and mantissa times 2^exponent.
  static Coordinate split(double value) {
    const auto pattern = std::bit_cast<std::uint64_t>(value);
    constexpr unsigned fraction_bits = 52;
    constexpr int least_exponent = -1074;
    const std::uint64_t fraction = pattern & ((std::uint64_t{1} << fraction_bits) - 1);
    const auto biased = static_cast<int>(pattern >> fraction_bits & 0x7ff);
    const bool negative = pattern >> 63 != 0;
    if (biased == 0) return {fraction, least_exponent, negative};
    return {fraction | std::uint64_t{1} << fraction_bits, least_exponent + biased - 1, negative};
  }

  std::array<std::array<std::array<Coordinate, 3>, 2>, 4> coordinates_;
  std::array<int, 3> least_;
  int bits_ = 0;
};

}  // namespace assay::detector
