#include "detector/exact/ball.h"

#include <gtest/gtest.h>

#include <random>

namespace assay::detector {
namespace {

using Wide = boost::multiprecision::cpp_int;

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
    for (int bits = between(0, most_bits); bits > 0; bits -= 32) {
      value = (value << 32) + static_cast<std::uint32_t>(engine_());
    }
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
    if (!sign) {
      ++unsure;
      continue;
    }
    ASSERT_EQ(*sign, sum.exact.sign()) << sum.exact;
    zeros += *sign == 0;
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
    if (bits > 60) {
      EXPECT_FALSE(sign.has_value()) << bits;
    }
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
