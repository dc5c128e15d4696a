// The parts of a query: enclosures, integer polynomials, algebraic times, and the test of boxes.
#include <gmpxx.h>

#include "oracle/mesh/feature_pairs.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/interval_sign.h"
#include "oracle/query/times/times.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::TimeEnclosure;

TEST(EncloseTime, FromAnyGuess) {
  const double time = 0.3;  // a double; just above it lies a time that is none
  for (const double guess : {0.0, 0.3, 0.30000001, 1.0, -5.0, 7.0, std::nan("")}) {
    auto exact = [&](double t) { return time > t ? 1 : (time < t ? -1 : 0); };
    EXPECT_EQ(enclose_time(guess, 0, 1, exact), (TimeEnclosure{time, time})) << guess;
    auto above = [&](double t) { return time >= t ? 1 : -1; };
    EXPECT_EQ(enclose_time(guess, 0, 1, above), (TimeEnclosure{time, std::nextafter(time, 1)}))
        << guess;
  }
}

TEST(EncloseTime, AtTheEnds) {
  auto at = [](double time) {
    return enclose_time(0.5, 0, 1, [=](double t) { return time > t ? 1 : (time < t ? -1 : 0); });
  };
  EXPECT_EQ(at(0), (TimeEnclosure{0, 0}));
  EXPECT_EQ(at(1), (TimeEnclosure{1, 1}));
  EXPECT_EQ(at(5e-324), (TimeEnclosure{5e-324, 5e-324}));
}

TEST(IntegerPolynomial, SignsAtDoubles) {
  const IntegerPolynomial p = {{-1, 0, 2}};  // 2 t^2 - 1
  const double below = 0x1.6a09e667f3bccp-1;
  EXPECT_EQ(sign_at(p, below), -1);
  EXPECT_EQ(sign_at(p, std::nextafter(below, 1)), 1);
  EXPECT_EQ(sign_at(p, 0), -1);
  EXPECT_EQ(sign_at(p, 1), 1);
  EXPECT_EQ(sign_at(p, 5e-324), -1);
  EXPECT_EQ(sign_at(IntegerPolynomial{{0, 1, -2}}, 0.5), 0);
  EXPECT_EQ(sign_at(IntegerPolynomial{}, 0.5), 0);
}

TEST(IntegerPolynomial, ArithmeticTrims) {
  const IntegerPolynomial t = linear(0, 1), one = linear(1, 1);
  EXPECT_EQ(one.degree(), 0);
  EXPECT_TRUE((t - t).is_zero());
  EXPECT_TRUE((t * IntegerPolynomial{}).is_zero());
  EXPECT_EQ(((t - one) * (t + one)).c, (std::vector<Integer>{-1, 0, 1}));
  EXPECT_EQ((-t).c, (std::vector<Integer>{0, -1}));
}

TEST(IntegerPolynomial, NoZeroInTheStep) {
  EXPECT_TRUE(surely_no_zero_in_unit({{1, 1}}));
  EXPECT_TRUE(surely_no_zero_in_unit({{3, -2}}));
  EXPECT_FALSE(surely_no_zero_in_unit({{1, -1}}));
  EXPECT_FALSE(surely_no_zero_in_unit({{0, 1}}));
  EXPECT_FALSE(surely_no_zero_in_unit({{1, -4, 4}}));  // double zero at 1/2
  EXPECT_FALSE(surely_no_zero_in_unit({}));
}

TEST(IntegerScale, IsExact) {
  const std::vector<detector::MovingPoint> points = {{{0.75, -8, 0}, {3, 5e-324, 1e300}}};
  const IntegerScale scale(points);
  EXPECT_EQ(scale(5e-324), 1);
  EXPECT_EQ(scale(-8), -(Integer(1) << 1077));
  EXPECT_EQ(scale(0.75) * 4, scale(3));
  EXPECT_EQ(scale(0), 0);
  const std::vector<detector::MovingPoint> even = {{{2, 4, 6}, {8, 10, 12}}};
  EXPECT_EQ(IntegerScale(even)(6), 3);
}

TEST(AlgebraicTimes, DistinctAndAscending) {
  const IntegerPolynomial t = linear(0, 1), a = {{-1, 2}}, b = {{-1, 0, 2}};
  const std::vector<IntegerPolynomial> ps = {a * a * b, b, t * a, {{7}}};
  const AlgebraicTimes times(ps);
  ASSERT_EQ(times.size(), 3);  // 0, 1/2, sqrt(1/2)
  EXPECT_EQ(times.enclosure(0), (TimeEnclosure{0, 0}));
  EXPECT_EQ(times.enclosure(1), (TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(times.enclosure(2), (TimeEnclosure{0x1.6a09e667f3bccp-1, 0x1.6a09e667f3bcdp-1}));
  EXPECT_EQ(times.sign(b, 2), 0);
  EXPECT_EQ(times.sign(a, 2), 1);
  EXPECT_EQ(times.sign(a, 0), -1);
  EXPECT_EQ(times.sign(a, 1), 0);
  EXPECT_EQ(times.sign({}, 1), 0);
  EXPECT_EQ(times.sign({{-3}}, 1), -1);
}

TEST(AlgebraicTimes, RationalZeroThatRefinementMeets) {
  // (8 t - 3)(t^2 - 2): 3/8 is a zero of a cubic that bisection meets exactly.
  const IntegerPolynomial p = IntegerPolynomial{{-3, 8}} * IntegerPolynomial{{-2, 0, 1}};
  const AlgebraicTimes times({&p, 1});
  ASSERT_EQ(times.size(), 1);
  // Beside 3/8 by 2^-40: needs refinement down to it.
  const Integer big = Integer(1) << 40;
  EXPECT_EQ(times.sign({{-(3 * big / 8 + 1), big}}, 0), -1);
  EXPECT_EQ(times.sign({{-(3 * big / 8 - 1), big}}, 0), 1);
  EXPECT_EQ(times.sign({{-3, 8}}, 0), 0);
  EXPECT_EQ(times.enclosure(0), (TimeEnclosure{0.375, 0.375}));
}

TEST(SimpleZero, AgreesWithTheKernel) {
  test::Random random(51);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    IntegerPolynomial p;
    for (int k = 0; k < 4; ++k) p.c.emplace_back(std::ldexp(random.unit(), random.below(60) + 52));
    if (sgn(p.c[3]) == 0 || sign_at(p, 0) * sign_at(p, 1) >= 0) continue;
    const AlgebraicTimes times({&p, 1});
    if (times.size() != 1) continue;
    ++compared;
    EXPECT_EQ(simple_zero_time(p, 0, 1), times.enclosure(0)) << i;
  }
  EXPECT_GT(compared, 50);
}

TEST(BoxTree, BruteForceAgrees) {
  test::Random random(52);
  for (const int scale : {0, 1020, -1070}) {
    std::vector<Box> boxes(300);
    for (Box& box : boxes) {
      for (int k = 0; k < 3; ++k) {
        const double x = random.integer(8), y = x + random.below(3);
        box.min[k] = std::ldexp(x, scale);
        box.max[k] = std::ldexp(y, scale);
      }
    }
    const BoxTree tree(boxes);
    std::vector<std::int32_t> found;
    for (const Box& a : boxes) {
      std::vector<std::int32_t> expected;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        bool meet = true;
        for (int k = 0; k < 3; ++k)
          meet = meet && a.min[k] <= boxes[i].max[k] && boxes[i].min[k] <= a.max[k];
        if (meet) expected.push_back(static_cast<std::int32_t>(i));
      }
      tree.meeting(a, found);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, Empty) {
  const BoxTree tree({});
  std::vector<std::int32_t> found = {1};
  tree.meeting({{0, 0, 0}, {1, 1, 1}}, found);
  EXPECT_TRUE(found.empty());
}

// The widening of 2^-52 |r| and the least double: exact results lie inside, for ordinary numbers
// and for denormals.

TEST(Enclosure, HoldsExactResults) {
  test::Random random(168);
  constexpr int rounds = 20000;
  for (int i = 0; i < rounds; ++i) {
    const int spread = i % 3 == 0 ? 1 : 60, centre = i % 2 == 0 ? 0 : -535;
    const auto number = [&] { return std::ldexp(random.unit(), centre + random.below(spread)); };
    const double a = number(), b = number();
    const auto expect = [&](const Enclosure& found, const mpq_class& exact) {
      ASSERT_LE(mpq_class(found.lo), exact) << a << " " << b;
      ASSERT_GE(mpq_class(found.hi), exact) << a << " " << b;
    };
    const mpq_class x(a), y(b);
    expect(Enclosure(a) + Enclosure(b), x + y);
    expect(Enclosure(a) - Enclosure(b), x - y);
    expect(a * Enclosure(b), x * y);
    expect(square(Enclosure(a)), x * x);
    const Enclosure apart = Enclosure(a) - Enclosure(b);
    expect(square(apart), (x - y) * (x - y));
    expect(b * (apart + Enclosure(b)), y * x);
    EXPECT_GT(apart.hi, apart.lo);
  }
}

}  // namespace
}  // namespace assay::oracle
