// Integers of fixed width against Boost's without bound.
#include "detector/exact/fixed_integer.h"

#include <gtest/gtest.h>

#include <random>

#include "detector/contact/fixed_root.h"

namespace assay::detector {
namespace {

// Of at most `bits` bits, often much shorter, often next to a power of two: carries and borrows.
template <std::size_t limbs>
FixedInteger<limbs> draw(std::mt19937_64& engine, int most_bits_drawn) {
  FixedInteger<limbs> value;
  const auto bits = static_cast<unsigned>(engine() % static_cast<unsigned>(most_bits_drawn + 1));
  const auto one = FixedInteger<limbs>(1);
  if (engine() % 3 == 0) {
    if (bits > 0) value = one.shifted(bits - 1) - FixedInteger<limbs>(engine() % 2 ? 1 : 0);
  } else {
    for (std::size_t i = 0; i < limbs; ++i) value.limb(i) = engine();
    for (std::size_t i = 0; i < limbs; ++i) {
      const auto below = 64 * i;
      if (bits <= below) value.limb(i) = 0;
      if (bits > below && bits < below + 64)
        value.limb(i) &= (std::uint64_t{1} << (bits - below)) - 1;
    }
  }
  return engine() % 2 ? -value : value;
}

template <std::size_t m, std::size_t n>
void compare(std::mt19937_64& engine) {
  for (int i = 0; i < 20000; ++i) {
    const auto a = draw<m>(engine, 64 * m - 2), b = draw<m>(engine, 64 * m - 2);
    const auto c = draw<n>(engine, 64 * n - 2);
    const Integer x = integer_of(a), y = integer_of(b), z = integer_of(c);
    ASSERT_EQ(integer_of(a + b), x + y);
    ASSERT_EQ(integer_of(a - b), x - y);
    ASSERT_EQ(integer_of(-a), -x);
    ASSERT_EQ(integer_of(a * c), x * z);
    ASSERT_EQ(a.sign(), x.sign());
    ASSERT_EQ(a.is_zero(), x.is_zero());
    const FixedInteger<m + 3> wide(a);
    const auto count = static_cast<unsigned>(engine() % 130);
    const std::uint64_t factor = engine() >> 1;
    ASSERT_EQ(integer_of(wide), x);
    ASSERT_EQ(integer_of(FixedInteger<m>(wide)), x);
    ASSERT_EQ(integer_of(wide.shifted(count)), x * (Integer(1) << count));
    ASSERT_EQ(integer_of(wide.times(factor)), x * factor);
    const double exact = x.template convert_to<double>();
    ASSERT_NEAR(a.approximate(0), exact, 4 * 0x1p-53 * std::abs(exact));
  }
}

TEST(FixedInteger, AgreesWithIntegersWithoutBound) {
  std::mt19937_64 engine(4711);
  compare<1, 1>(engine);
  compare<1, 2>(engine);
  compare<2, 2>(engine);
  compare<3, 2>(engine);
  compare<5, 10>(engine);
}

}  // namespace
}  // namespace assay::detector
