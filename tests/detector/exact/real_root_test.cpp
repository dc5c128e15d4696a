#include "detector/exact/real_root.h"

#include "detector/exact/root_isolation.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// Ascending powers.
Polynomial polynomial(std::initializer_list<std::int64_t> coefficients) {
  Polynomial p, power = Polynomial::constant(1);
  const Polynomial t = Polynomial::linear(0, 1);
  for (const auto c : coefficients) {
    p = p + Polynomial::constant(c) * power;
    power = power * t;
  }
  return p;
}

// a - b t
Polynomial factor(std::int64_t a, std::int64_t b) { return polynomial({a, -b}); }

void expect_exact(const RealRoot& root, double time) {
  EXPECT_EQ(root.enclosure().lo, time);
  EXPECT_EQ(root.enclosure().hi, time);
}

void expect_between_doubles(const RealRoot& root, double near) {
  EXPECT_EQ(root.enclosure().hi, std::nextafter(root.enclosure().lo, 2.0));
  EXPECT_LE(root.enclosure().lo, near);
  EXPECT_GE(root.enclosure().hi, near);
}

TEST(RealRoot, FindsRootsAtTheEndsAndInside) {
  const auto roots = roots_in_unit_interval(factor(0, 1) * factor(1, 4) * factor(1, 1));
  ASSERT_EQ(roots.size(), 3u);
  expect_exact(roots[0], 0);
  expect_exact(roots[1], 0.25);
  expect_exact(roots[2], 1);
}

TEST(RealRoot, EnclosesAThirdInAdjacentDoubles) {
  const auto roots = roots_in_unit_interval(factor(1, 3));
  ASSERT_EQ(roots.size(), 1u);
  expect_between_doubles(roots[0], 1.0 / 3);
}

TEST(RealRoot, ReportsAMultipleRootOnce) {
  const auto roots = roots_in_unit_interval(factor(1, 3) * factor(1, 3) * factor(3, 4));
  ASSERT_EQ(roots.size(), 2u);
  expect_between_doubles(roots[0], 1.0 / 3);
  expect_exact(roots[1], 0.75);
  EXPECT_EQ(roots_in_unit_interval(factor(1, 2) * factor(1, 2) * factor(1, 2)).size(), 1u);
}

TEST(RealRoot, IgnoresRootsOutside) {
  EXPECT_TRUE(roots_in_unit_interval(factor(3, 2) * factor(-1, 7) * factor(5, 1)).empty());
  EXPECT_FALSE(has_root_in_unit_interval(polynomial({1, 0, 1})));
}

TEST(RealRoot, SeparatesRootsThatShareOneGapOfDoubles) {
  // 1/3 and 1/3 + 1/(3 (2^70)): closer than any two doubles there.
  const Integer big = Integer(1) << 70;
  const Polynomial close = Polynomial::linear(-(big + 1), -(big + 1) + 3 * big);
  const auto roots = roots_in_unit_interval(factor(1, 3) * close);
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_EQ(roots[0].enclosure(), roots[1].enclosure());
  // 3t - 1 vanishes at the first and is positive at the second.
  EXPECT_EQ(roots[0].sign_of(polynomial({-1, 3})), 0);
  EXPECT_EQ(roots[1].sign_of(polynomial({-1, 3})), 1);
}

TEST(RealRoot, FindsTinyRootsWithoutManySteps) {
  const Integer huge = Integer(1) << 1074;
  const auto roots = roots_in_unit_interval(Polynomial::linear(-1, -1 + huge));  // t = 2^-1074
  ASSERT_EQ(roots.size(), 1u);
  expect_exact(roots[0], 0x1p-1074);
}

// All below the least double: 2^-2000, 2^-1500 and 3 2^-1100.
TEST(RealRoot, SeparatesRootsOfAllMagnitudesNextToZero) {
  const auto tiny = [](unsigned exponent, int numerator) {
    return Polynomial::linear(-numerator, -numerator + (Integer(1) << exponent));
  };
  const auto roots = roots_in_unit_interval(tiny(1100, 3) * tiny(2000, 1) * tiny(1500, 1));
  ASSERT_EQ(roots.size(), 3u);
  for (const auto& root : roots) EXPECT_EQ(root.enclosure(), (TimeEnclosure{0, 0x1p-1074}));
  EXPECT_EQ(roots[0].sign_of(tiny(2000, 1)), 0);
  EXPECT_EQ(roots[1].sign_of(tiny(2000, 1)), 1);
  EXPECT_EQ(roots[1].sign_of(tiny(1500, 1) * tiny(1700, 1)), 0);
  EXPECT_EQ(roots[1].sign_of(tiny(1499, 1) * tiny(1700, 1)), -1);
  EXPECT_EQ(roots[2].sign_of(tiny(1100, 3)), 0);
}

TEST(RealRoot, SignAtAnIrrationalRoot) {
  // t^2 = 1/2.
  const auto roots = roots_in_unit_interval(polynomial({-1, 0, 2}));
  ASSERT_EQ(roots.size(), 1u);
  expect_between_doubles(roots[0], std::sqrt(0.5));
  EXPECT_EQ(roots[0].sign_of(polynomial({-1, 0, 2})), 0);
  EXPECT_EQ(roots[0].sign_of(polynomial({-7071067, 10000000})), 1);
  EXPECT_EQ(roots[0].sign_of(polynomial({-7071068, 10000000})), -1);
  EXPECT_EQ(roots[0].sign_of(polynomial({5, 0, -10})), 0);
  EXPECT_EQ(roots[0].sign_of(factor(1, 3) * factor(3, 4)), -1);
  EXPECT_EQ(roots[0].sign_of(factor(7, 10) * factor(7, 10)), 1);
  EXPECT_EQ(roots[0].sign_of(polynomial({-1, 0, 2}) + Polynomial::constant(1)), 1);
  EXPECT_EQ(roots[0].sign_of(Polynomial()), 0);
}

// Quadratics whose roots share the gap of doubles with the root, by all orders of the three.
TEST(RealRoot, SignsOfQuadraticsWithRootsInTheSameGap) {
  const Integer unit = Integer(1) << 80;
  // 1/3 + n 2^-80
  const auto beside_a_third = [&](int n) {
    return Polynomial::linear(-(unit + 3 * n), 3 * unit - (unit + 3 * n));
  };
  for (int r = -2; r <= 2; ++r) {
    const Polynomial f = beside_a_third(r) * factor(-1, 1) * polynomial({2, 1, 1});
    const auto roots = roots_in_unit_interval(f);
    ASSERT_EQ(roots.size(), 1u);
    for (int a = -2; a <= 2; ++a) {
      const int to_a = r > a ? 1 : r < a ? -1 : 0;
      EXPECT_EQ(roots[0].sign_of(beside_a_third(a)), to_a);
      EXPECT_EQ(roots[0].sign_of(beside_a_third(a) * factor(3, 1)), to_a);
      for (int b = -2; b <= 2; ++b) {
        const int to_b = r > b ? 1 : r < b ? -1 : 0;
        EXPECT_EQ(roots[0].sign_of(beside_a_third(a) * beside_a_third(b)), to_a * to_b);
        EXPECT_EQ(roots[0].sign_of(-(beside_a_third(a) * beside_a_third(b))), -to_a * to_b);
      }
    }
  }
}

// A root at a double, and the other one in the gap behind it: f vanishes where the gap begins.
TEST(RealRoot, RootsAtAnEndOfTheirGap) {
  const Integer unit = Integer(1) << 90;
  const Polynomial behind_a_half = Polynomial::linear(-(unit + 2), 2 * unit - (unit + 2));
  const auto roots = roots_in_unit_interval(factor(1, 2) * behind_a_half * factor(1, 3));
  ASSERT_EQ(roots.size(), 3u);
  expect_exact(roots[1], 0.5);
  EXPECT_EQ(roots[2].enclosure(), (TimeEnclosure{0.5, std::nextafter(0.5, 1)}));
  EXPECT_EQ(roots[2].sign_of(behind_a_half), 0);
  EXPECT_EQ(roots[2].sign_of(factor(1, 2)), -1);
  EXPECT_EQ(roots[2].sign_of(factor(1, 2) * behind_a_half), 0);
  EXPECT_EQ(roots[2].sign_of(factor(1, 2) * factor(1, 2)), 1);
  EXPECT_EQ(roots[1].sign_of(behind_a_half * factor(1, 2)), 0);
}

TEST(RealRoot, FindsAllRootsOfAQuintic) {
  const auto roots = roots_in_unit_interval(factor(1, 7) * factor(1, 5) * factor(1, 3) *
                                            factor(2, 3) * factor(6, 7));
  ASSERT_EQ(roots.size(), 5u);
  const double expected[] = {1.0 / 7, 0.2, 1.0 / 3, 2.0 / 3, 6.0 / 7};
  for (std::size_t i = 0; i < roots.size(); ++i) expect_between_doubles(roots[i], expected[i]);
}

TEST(RealRoot, BracketedRootIsTheSameFromAnyGuess) {
  const Polynomial f = polynomial({-1, 0, 2});
  const auto roots = roots_in_unit_interval(f);
  for (const double guess : {-1.0, 1e-300, 0.3, 0.70710678, 0.99}) {
    EXPECT_EQ(enclose_single_root(f, 0, 1, guess), roots[0].enclosure()) << guess;
  }
}

// At the ends of a bracket the function may have any sign, or none: it has another root there.
TEST(BracketRoot, AsksInsideAloneFromEveryGuess) {
  constexpr std::uint64_t room = 700;
  for (const double end : {0x1p-1022, 0x1p-60, 0.25, 1.0}) {
    const std::uint64_t last = ordinal(end), first = last - room;
    for (const std::uint64_t root : {first, first + 1, first + 73, last - 74, last - 1}) {
      for (std::uint64_t guess = first; guess <= last; ++guess) {
        for (const int sign_lo : {1, -1}) {
          // The root lies behind the double `root`, and before the next one.
          const auto sign_at = [&](double t) {
            EXPECT_TRUE(ordinal(t) > first && ordinal(t) < last) << "an end is asked";
            return ordinal(t) <= root ? sign_lo : -sign_lo;
          };
          const TimeEnclosure found = bracket_root(sign_at, sign_lo, from_ordinal(first),
                                                   from_ordinal(last), from_ordinal(guess));
          EXPECT_EQ(ordinal(found.lo), root);
          EXPECT_EQ(ordinal(found.hi), root + 1);
        }
      }
    }
  }
}

// Signs of polynomials of any degree at a root that is no double, from far to within the same gap
// of doubles, and of one that vanishes there, with other roots and multiple ones beside it.
TEST(RealRoot, SignsOfAnyDegree) {
  const Polynomial third = factor(1, 3), square = polynomial({1, 0, -2});  // 1/sqrt(2)
  // a / b differs from 1/3 by about 1e-18, and both are in one gap of doubles.
  const Polynomial just_below = factor(333333333333333333, 1000000000000000000);
  for (const Polynomial& f :
       {third, third * square * polynomial({1, 1, 1}), third * square * square}) {
    const auto roots = roots_in_unit_interval(f);
    const RealRoot& root = roots.front();
    ASSERT_LT(root.enclosure().lo, root.enclosure().hi);
    EXPECT_EQ(root.sign_of(polynomial({1, 0, 0, 0, 1})), 1);
    EXPECT_EQ(root.sign_of(polynomial({-1, 2, 0, 1})), -1);
    EXPECT_EQ(root.sign_of(third * polynomial({1, 0, 1})), 0);
    EXPECT_EQ(root.sign_of(third * third * just_below * factor(1, 2)), 0);
    EXPECT_EQ(root.sign_of(just_below * polynomial({1, 0, 1})), -1);
    EXPECT_EQ(root.sign_of(just_below * just_below * factor(1, 2)), 1);
    EXPECT_EQ(root.sign_of(-(just_below * just_below * just_below)), 1);
    EXPECT_EQ(root.sign_of(just_below * third * factor(1, 2)), 0);
  }
  // Quadratic and quartic numbers.
  const RealRoot half_root = roots_in_unit_interval(square).front();
  EXPECT_EQ(half_root.sign_of(polynomial({1, 0, 0, 0, -4})), 0);
  EXPECT_EQ(half_root.sign_of(polynomial({1, 0, 0, 0, -4}) * factor(2, 3)), 0);
  EXPECT_EQ(half_root.sign_of(polynomial({1, 0, 0, -3})), -1);
}

}  // namespace
}  // namespace assay::detector
