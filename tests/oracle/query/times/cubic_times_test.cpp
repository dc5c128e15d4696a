// Zeros of cubics: beside CGAL's algebraic kernel, and with known places.
#include "oracle/query/times/cubic_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "oracle/query/times/algebraic_times.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::TimeEnclosure;
using test::Random;

// So that braces can stand for a factor.
IntegerPolynomial product(const IntegerPolynomial& a, const IntegerPolynomial& b,
                          const IntegerPolynomial& c) {
  return a * b * c;
}

TEST(CubicTimes, ZerosAtTheEndsAndOfAnyMultiplicity) {
  const IntegerPolynomial at_0 = {{0, 1}}, at_1 = {{-1, 1}}, at_half = {{-1, 2}};
  const CubicTimes three(product(at_0, at_half, at_1));
  ASSERT_EQ(three.size(), 3);
  EXPECT_EQ(three.enclosure(0), (TimeEnclosure{0, 0}));
  EXPECT_EQ(three.enclosure(1), (TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(three.enclosure(2), (TimeEnclosure{1, 1}));
  EXPECT_EQ(three.sign(at_half, 0), -1);
  EXPECT_EQ(three.sign(at_half, 1), 0);
  EXPECT_EQ(three.sign(at_half, 2), 1);
  for (const auto& f :
       {product(at_half, at_half, at_1), product(at_half, at_half, {{-5, 1}}),
        product(at_half, at_half, at_half), product(at_half, {{1, 0, 1}}, {{-7}})}) {
    const CubicTimes times(f);
    ASSERT_GE(times.size(), 1);
    EXPECT_EQ(times.enclosure(0), (TimeEnclosure{0.5, 0.5}));
    EXPECT_EQ(times.sign(at_half, 0), 0);
    EXPECT_EQ(times.sign(at_half * at_half, 0), 0);
    EXPECT_EQ(times.sign({{-1, 1, 4}}, 0), 1);
    EXPECT_EQ(times.sign({{-2, 1, 4}}, 0), -1);
  }
  EXPECT_EQ(CubicTimes(product({{1, 1}}, {{2, 1}}, {{-5, 1}})).size(), 0);
}

TEST(CubicTimes, ACubeRootBetweenDoubles) {
  const CubicTimes times({{-1, 0, 0, 2}});
  ASSERT_EQ(times.size(), 1);
  const double below = 0x1.965fea53d6e3cp-1;
  EXPECT_EQ(times.enclosure(0), (TimeEnclosure{below, std::nextafter(below, 1)}));
  // 0.7937 < r < 0.7938
  EXPECT_EQ(times.sign({{-7937, 10000}}, 0), 1);
  EXPECT_EQ(times.sign({{-7938, 10000}}, 0), -1);
  EXPECT_EQ(times.sign(IntegerPolynomial{{-7937, 10000}} * IntegerPolynomial{{-7938, 10000}}, 0),
            -1);
  EXPECT_EQ(times.sign(IntegerPolynomial{{-7937, 10000}} * IntegerPolynomial{{-7937, 10000}}, 0),
            1);
  EXPECT_EQ(times.sign({{1, -1, 1}}, 0), 1);
}

TEST(CubicTimes, ZerosNearerToTheSlopesZeroThanDoubles) {
  // (2t - 1)^2 (t + 1) = 2^-300 has its zeros within 2^-150 of 1/2, at which it is negative.
  const Integer huge = Integer(1) << 300;
  const IntegerPolynomial f =
      product({{-1, 2}}, {{-1, 2}}, {{1, 1}}) * IntegerPolynomial{{huge}} - IntegerPolynomial{{1}};
  const CubicTimes times(f);
  ASSERT_EQ(times.size(), 2);
  EXPECT_EQ(times.enclosure(0), (TimeEnclosure{std::nextafter(0.5, 0), 0.5}));
  EXPECT_EQ(times.enclosure(1), (TimeEnclosure{0.5, std::nextafter(0.5, 1)}));
  EXPECT_EQ(times.sign({{-1, 2}}, 0), -1);
  EXPECT_EQ(times.sign({{-1, 2}}, 1), 1);
}

// Random cubics, many of them products, and random quadratics, many of which share a factor.
TEST(CubicTimes, AgreeWithTheAlgebraicKernel) {
  Random random(34);
  int zeros = 0, common = 0;
  for (int round = 0; round < 600; ++round) {
    const int most = round % 2 == 0 ? 3 : 1000;
    auto line = [&] { return linear(random.integer(most), random.integer(most)); };
    auto quadratic = [&] {
      return IntegerPolynomial{{static_cast<int>(random.integer(most)),
                                static_cast<int>(random.integer(most)), 1 + random.below(most)}};
    };
    const IntegerPolynomial factor = line(), quad = quadratic();
    IntegerPolynomial f = random.below(3) == 0 ? quad * line() : factor * line() * line();
    if (random.below(3) == 0) f = f + IntegerPolynomial{{1 + random.below(most)}};
    if (f.degree() < 2) continue;
    const CubicTimes times(f);
    const AlgebraicTimes expected({&f, 1});
    ASSERT_EQ(times.size(), expected.size()) << round;
    for (int i = 0; i < times.size(); ++i, ++zeros) {
      EXPECT_EQ(times.enclosure(i), expected.enclosure(i)) << round;
      for (const auto& q : {factor, quad, factor * line(), factor * factor, quadratic(), line()}) {
        EXPECT_EQ(times.sign(q, i), expected.sign(q, i)) << round;
        common += times.sign(q, i) == 0;
      }
    }
  }
  std::printf("%d zeros, %d of these of other polynomials too\n", zeros, common);
  EXPECT_GT(common, zeros / 2);
}

}  // namespace
}  // namespace assay::oracle
