// Integers of fixed width, and balls, compared with integers of any size.
#include "detector/contact/fixed_root.h"
#include "detector/exact/ball.h"
#include "detector/exact/fixed_integer.h"
#include "tests/test.h"

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

// An integer and the ball that was computed beside it.
struct Beside {
  Integer exact;
  Ball ball;
};

class BallDraw {
 public:
  int between(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  Integer integer(int most_bits) {
    Integer value = 0;
    for (int bits = between(0, most_bits); bits > 0; bits -= 32)
      value = (value << 32) + static_cast<std::uint32_t>(engine_());
    return between(0, 1) ? value : Integer(-value);
  }

 private:
  std::mt19937_64 engine_{7};
};

// What a ball says of a sign is true, after any sums and products; and it says something unless
// nearly all cancels.
TEST(Ball, SignsAreThoseOfIntegers) {
  BallDraw draw;
  int unsure = 0, zeros = 0;
  constexpr int rounds = 20000;
  for (int round = 0; round < rounds; ++round) {
    Beside sum{0, Ball()};
    for (int terms = draw.between(1, 6); terms > 0; --terms) {
      Beside product{1, Ball(Integer(1))};
      for (int factors = draw.between(1, 4); factors > 0; --factors) {
        const Integer x = draw.integer(draw.between(0, 3) == 0 ? 2000 : 80);
        product = {product.exact * x, product.ball * Ball(x)};
      }
      sum = {sum.exact + product.exact, sum.ball + product.ball};
    }
    const auto sign = sum.ball.sign();
    unsure += !sign;
    ASSERT_EQ(sign.value_or(sum.exact.sign()), sum.exact.sign()) << sum.exact;
    zeros += sign == 0;
  }
  EXPECT_LT(unsure, rounds / 50);
  EXPECT_GT(zeros, 0);
}

// Differences of neighbouring numbers: beyond 53 bits the ball does not tell, and never wrongly.
TEST(Ball, DoesNotTellWhatItCannotKnow) {
  for (int bits = 1; bits < 3000; bits += 7) {
    const Integer x = (Integer(1) << static_cast<unsigned>(bits)) + 1;
    const Ball difference = Ball(x) + Ball(Integer(-(x - 1)));
    const auto sign = difference.sign();
    EXPECT_EQ(sign.has_value(), bits < 50 || sign == 1) << bits;
    EXPECT_FALSE(bits > 60 && sign) << bits;
  }
}

TEST(Ball, ExponentsDoNotEnd) {
  const Ball huge(Integer(3), 1'000'000), tiny(Integer(-5), -1'000'000);
  EXPECT_EQ((huge + tiny).sign(), 1);
  EXPECT_EQ((tiny + huge).sign(), 1);
  EXPECT_EQ((huge * tiny).sign(), -1);
  EXPECT_EQ((huge * tiny + Ball(Integer(15))).sign(), std::nullopt);
  EXPECT_EQ((huge * tiny + Ball(Integer(16))).sign(), 1);
  EXPECT_EQ((huge * Ball()).sign(), 0);
  EXPECT_EQ((Ball() + tiny).sign(), -1);
}

}  // namespace
}  // namespace assay::detector
