// Zeros of polynomials as exact numbers.
#include "oracle/query/times/times.h"

#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::TimeEnclosure, test::Random;

// Zeros of cubics: beside CGAL's algebraic kernel, and with known places.

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
  EXPECT_GT(common, zeros / 2);
}

// Zeros of quadratics as exact numbers: their signs, their order, their doubles.

std::vector<QuadraticTime> zeros_of(const IntegerPolynomial& p) {
  std::vector<QuadraticTime> zeros;
  QuadraticTime::append_zeros(p, zeros);
  return zeros;
}

constexpr double below_root_half = 0x1.6a09e667f3bccp-1;  // the double below the square root of 1/2
constexpr TimeEnclosure root_half = {below_root_half, 0x1.6a09e667f3bcdp-1};

TEST(QuadraticTime, SignsAtARationalZero) {
  const auto zeros = zeros_of({{1, -3}});  // 1/3
  ASSERT_EQ(zeros.size(), 1U);
  EXPECT_EQ(zeros[0].sign({{-1, 3}}), 0);
  EXPECT_EQ(zeros[0].sign({{-1, 4}}), 1);
  EXPECT_EQ(zeros[0].sign({{-1, 0, 9}}), 0);
  EXPECT_EQ(zeros[0].sign({{-2, 0, 9}}), -1);
  EXPECT_EQ(zeros[0].sign({{-7}}), -1);
  EXPECT_EQ(zeros[0].sign({}), 0);
}

TEST(QuadraticTime, SignsAtBothIrrationalZeros) {
  for (const int factor : {1, -5}) {  // the sign of the leading coefficient is no matter
    const auto zeros = zeros_of({{-1 * factor, 0, 2 * factor}});
    ASSERT_EQ(zeros.size(), 2U);
    const QuadraticTime &lesser = zeros[0], &greater = zeros[1];
    EXPECT_EQ(lesser.sign({{0, 1}}), -1);
    EXPECT_EQ(greater.sign({{0, 1}}), 1);
    EXPECT_EQ(greater.sign({{-3, 0, 6}}), 0);
    // 7/10 < sqrt(1/2) < 71/100.
    EXPECT_EQ(greater.sign({{-7, 10}}), 1);
    EXPECT_EQ(greater.sign({{-71, 100}}), -1);
    EXPECT_EQ(lesser.sign({{7, 10}}), -1);
    EXPECT_EQ(lesser.sign({{71, 100}}), 1);
    // (2t^2 - 1) + (10t - 7), of which the first is zero there.
    EXPECT_EQ(greater.sign({{-8, 10, 2}}), 1);
    EXPECT_EQ(greater.enclosure(), root_half);
  }
}

TEST(QuadraticTime, NoZeroOneZeroTwo) {
  EXPECT_TRUE(zeros_of({{1, 0, 1}}).empty());
  const auto twice = zeros_of({{1, -4, 4}});  // (2t - 1)^2
  ASSERT_EQ(twice.size(), 1U);
  EXPECT_EQ(twice[0].enclosure(), (TimeEnclosure{0.5, 0.5}));
  const auto rational = zeros_of({{1, -5, 4}});  // (4t - 1)(t - 1): the square root is 3
  ASSERT_EQ(rational.size(), 2U);
  EXPECT_EQ(rational[0].enclosure(), (TimeEnclosure{0.25, 0.25}));
  EXPECT_EQ(rational[1].enclosure(), (TimeEnclosure{1, 1}));
  EXPECT_EQ(rational[0].sign({{-1, 4}}), 0);
  EXPECT_EQ(rational[1].sign({{-1, 0, 1}}), 0);
}

TEST(QuadraticTime, ComparesZerosOfAnyKind) {
  // Ascending; each list holds the same number in several forms.
  const std::vector<std::vector<QuadraticTime>> ascending = {
      {zeros_of({{-1, 0, 2}})[0]},
      {zeros_of({{0, 1}})[0], zeros_of({{0, -1, 1}})[0], zeros_of({{0, 1, 1}})[1]},
      {zeros_of({{1, -3, 1}})[0]},  // 0.382
      {zeros_of({{-1, 2}})[0], zeros_of({{1, -4, 4}})[0], zeros_of({{1, -3, 2}})[0]},
      {zeros_of({{-1, 1, 1}})[1]},  // 0.618
      {zeros_of({{-1, 0, 2}})[1], zeros_of({{-4, 0, 8}})[1]},
      {zeros_of({{-3, 4}})[0]},
  };
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    for (std::size_t j = 0; j < ascending.size(); ++j) {
      const int expected = i < j ? -1 : (i > j ? 1 : 0);
      for (const QuadraticTime& x : ascending[i]) {
        for (const QuadraticTime& y : ascending[j]) EXPECT_EQ(x.compare(y), expected) << i << j;
      }
    }
  }
}

TEST(QuadraticTime, EnclosuresNearTheEnds) {
  const Integer huge = Integer(1) << 1200;
  EXPECT_EQ(zeros_of({{-1, huge}})[0].enclosure(), (TimeEnclosure{0, 5e-324}));
  EXPECT_EQ(zeros_of({{-1, huge, 1}})[1].enclosure(), (TimeEnclosure{0, 5e-324}));
  EXPECT_EQ(zeros_of({{-1, 0, huge}})[1].enclosure(), (TimeEnclosure{0x1p-600, 0x1p-600}));
  const double last = std::nextafter(1.0, 0.0);
  EXPECT_EQ(zeros_of({{1 - huge, huge}})[0].enclosure(), (TimeEnclosure{last, 1}));
}

// As the kernel finds them: random polynomials, many of which share zeros.
TEST(QuadraticTimes, AgreeWithTheAlgebraicKernel) {
  Random random(31);
  int zeros = 0, common = 0;
  for (int round = 0; round < 400; ++round) {
    const int most = round % 2 == 0 ? 3 : 40;
    auto polynomial = [&] {
      IntegerPolynomial p = linear(random.integer(most), random.integer(most));
      if (random.below(2) == 0) return p;
      if (random.below(2) == 0) return p * linear(random.integer(most), random.integer(most));
      return p * linear(1, 0) + IntegerPolynomial{{0, 0, 1}} * IntegerPolynomial{{1 + most}};
    };
    std::vector<IntegerPolynomial> events;
    for (int i = 0; i < 3; ++i) {
      if (auto p = polynomial(); !p.is_zero()) events.push_back(std::move(p));
    }
    const AlgebraicTimes expected(events);
    const QuadraticTimes times(events);
    ASSERT_EQ(times.size(), expected.size()) << round;
    for (int i = 0; i < times.size(); ++i, ++zeros) {
      EXPECT_EQ(times.enclosure(i), expected.enclosure(i)) << round;
      for (const IntegerPolynomial& p : events) {
        EXPECT_EQ(times.sign(p, i), expected.sign(p, i)) << round;
        common += times.sign(p, i) == 0;
      }
      for (int k = 0; k < 4; ++k) {
        const IntegerPolynomial q = polynomial();
        EXPECT_EQ(times.sign(q, i), expected.sign(q, i)) << round;
      }
    }
  }
  EXPECT_GT(common, zeros);
}

}  // namespace
}  // namespace assay::oracle
