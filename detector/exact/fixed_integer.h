// Integers of a fixed number of 64-bit limbs on the stack, in two's complement, for values whose
// bound is known beforehand. They need no allocation, store no length and have hardly a branch. A
// result that does not fit wraps around, so the code that uses these integers has to prove that its
// results fit.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace assay::detector {

__extension__ using DoubleLimb = unsigned __int128;
__extension__ using SignedDoubleLimb = __int128;

template <std::size_t limbs>
class FixedInteger {
 public:
  static constexpr std::size_t bits = 64 * limbs;

  FixedInteger() = default;  // zero
  FixedInteger(std::int64_t value) {
    limb_[0] = static_cast<std::uint64_t>(value);
    fill_from(1, value < 0);
  }
  // Converts a value from another width. REQUIRES that it fits.
  template <std::size_t others>
  explicit FixedInteger(const FixedInteger<others>& value) {
    for (std::size_t i = 0; i < limbs && i < others; ++i) limb_[i] = value.limb(i);
    if constexpr (others < limbs) fill_from(others, value.negative());
  }

  std::uint64_t limb(std::size_t i) const { return limb_[i]; }
  std::uint64_t& limb(std::size_t i) { return limb_[i]; }
  bool negative() const { return static_cast<std::int64_t>(limb_[limbs - 1]) < 0; }
  bool is_zero() const {
    std::uint64_t any = 0;
    for (const auto l : limb_) any |= l;
    return any == 0;
  }
  int sign() const { return negative() ? -1 : is_zero() ? 0 : 1; }

  friend FixedInteger operator+(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger sum;
    DoubleLimb carry = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      carry += static_cast<DoubleLimb>(a.limb_[i]) + b.limb_[i];
      sum.limb_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend FixedInteger operator-(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger rest;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      const DoubleLimb d = static_cast<DoubleLimb>(a.limb_[i]) - b.limb_[i] - borrow;
      rest.limb_[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
    return rest;
  }
  FixedInteger operator-() const { return FixedInteger() - *this; }

  // Returns the value times 2^count.
  FixedInteger shifted(unsigned count) const {
    const std::size_t whole = count / 64;
    const unsigned part = count % 64;
    FixedInteger out;
    for (std::size_t i = limbs; i-- > whole;) {
      out.limb_[i] = limb_[i - whole] << part;
      if (part != 0 && i > whole) out.limb_[i] |= limb_[i - whole - 1] >> (64 - part);
    }
    return out;
  }
  // Returns the value times a factor below 2^63. It is cheaper than a full product.
  FixedInteger times(std::uint64_t factor) const {
    FixedInteger out;
    DoubleLimb carry = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      carry += static_cast<DoubleLimb>(limb_[i]) * factor;
      out.limb_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return out;
  }

  // Returns the value divided by 2^scale, off by some units in the last place: good for guesses.
  double approximate(int scale) const {
    const FixedInteger size = negative() ? -*this : *this;
    std::size_t top = limbs - 1;
    while (top > 0 && size.limb_[top] == 0) --top;
    double value = static_cast<double>(size.limb_[top]);
    if (top > 0) value += 0x1p-64 * static_cast<double>(size.limb_[top - 1]);
    return std::ldexp(negative() ? -value : value, 64 * static_cast<int>(top) - scale);
  }

 private:
  void fill_from(std::size_t begin, bool negative_value) {
    for (std::size_t i = begin; i < limbs; ++i) limb_[i] = negative_value ? ~std::uint64_t{0} : 0;
  }

  std::array<std::uint64_t, limbs> limb_ = {};  // least significant first
};

// Returns the whole product. The limbs are multiplied as if both values were unsigned, and read in
// this way a negative value is too large by 2^bits. To correct this, the other value is subtracted
// from the upper limbs of the product.
template <std::size_t m, std::size_t n>
FixedInteger<m + n> operator*(const FixedInteger<m>& a, const FixedInteger<n>& b) {
  FixedInteger<m + n> product;
  if constexpr (m == 1 && n == 1) {
    const auto whole = static_cast<SignedDoubleLimb>(static_cast<std::int64_t>(a.limb(0))) *
                       static_cast<std::int64_t>(b.limb(0));
    product.limb(0) = static_cast<std::uint64_t>(whole);
    product.limb(1) = static_cast<std::uint64_t>(whole >> 64);
    return product;
  }
  for (std::size_t i = 0; i < m; ++i) {
    DoubleLimb carry = 0;
    for (std::size_t j = 0; j < n; ++j) {
      carry += static_cast<DoubleLimb>(a.limb(i)) * b.limb(j) + product.limb(i + j);
      product.limb(i + j) = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    product.limb(i + n) = static_cast<std::uint64_t>(carry);
  }
  const auto take_off = [&product](const auto& other, std::size_t count, std::size_t place,
                                   std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const DoubleLimb d =
          static_cast<DoubleLimb>(product.limb(place + i)) - (other.limb(i) & mask) - borrow;
      product.limb(place + i) = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
  };
  take_off(b, n, m, a.negative() ? ~std::uint64_t{0} : 0);
  take_off(a, m, n, b.negative() ? ~std::uint64_t{0} : 0);
  return product;
}

}  // namespace assay::detector
