// Roots of polynomials in the unit interval, and signs at them.
#include "detector/exact/real_root.h"

#include <rapidcheck/gtest.h>

#include "detector/exact/root_isolation.h"
#include "tests/detector/exact/tarski.h"
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

// At the ends and inside, of one time or several, and none outside.
TEST(RealRoot, FindsEachRootOfTheIntervalOnce) {
  const std::vector<std::pair<Polynomial, std::vector<double>>> table = {
      {factor(0, 1) * factor(1, 4) * factor(1, 1), {0, 0.25, 1}},
      {factor(1, 3), {1.0 / 3}},
      {factor(1, 3) * factor(1, 3) * factor(3, 4), {1.0 / 3, 0.75}},
      {factor(1, 2) * factor(1, 2) * factor(1, 2), {0.5}},
      {factor(3, 2) * factor(-1, 7) * factor(5, 1), {}},
      {factor(1, 7) * factor(1, 5) * factor(1, 3) * factor(2, 3) * factor(6, 7),
       {1.0 / 7, 0.2, 1.0 / 3, 2.0 / 3, 6.0 / 7}}};
  for (std::size_t row = 0; row < table.size(); ++row) {
    SCOPED_TRACE(row);
    const auto& [f, times] = table[row];
    const auto roots = roots_in_unit_interval(f);
    ASSERT_EQ(roots.size(), times.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
      (4 * times[i] == std::round(4 * times[i]) ? expect_exact : expect_between_doubles)(roots[i],
                                                                                         times[i]);
  }
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

TEST(RealRoot, BracketedRootIsTheSameFromAnyGuess) {
  const Polynomial f = polynomial({-1, 0, 2});
  const auto roots = roots_in_unit_interval(f);
  for (const double guess : {-1.0, 1e-300, 0.3, 0.70710678, 0.99})
    EXPECT_EQ(enclose_single_root(f, 0, 1, guess), roots[0].enclosure()) << guess;
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

// Roots that share a gap between doubles, made from the roots themselves: each must be found, in
// order, and the work must grow with the logarithm of the bits that separate them.

// numerator / denominator, which is above 0
struct RationalRoot {
  Integer numerator, denominator;
  friend RationalRoot operator+(const RationalRoot& a, const RationalRoot& b) {
    return {a.numerator * b.denominator + b.numerator * a.denominator,
            a.denominator * b.denominator};
  }
  friend bool operator<(const RationalRoot& a, const RationalRoot& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
  friend bool operator==(const RationalRoot& a, const RationalRoot& b) {
    return !(a < b) && !(b < a);
  }
};

RationalRoot fraction(int numerator, int denominator) { return {numerator, denominator}; }
RationalRoot dyadic_root(int numerator, int bits) {
  return {numerator, Integer(1) << static_cast<unsigned>(bits)};
}
RationalRoot double_root(double time) {
  const Binary b = binary_of(time);
  return {b.mantissa, Integer(1) << static_cast<unsigned>(-b.exponent)};
}

Polynomial vanishing_at_root(const RationalRoot& r) {
  return Polynomial::linear(-r.numerator, r.denominator - r.numerator);
}

Polynomial product_over(const std::vector<RationalRoot>& roots) {
  Polynomial f = Polynomial::constant(3);
  for (const auto& r : roots) f = f * vanishing_at_root(r);
  return f;
}

// The adjacent doubles around a time that is no double itself.
TimeEnclosure gap_around(const RationalRoot& r) {
  return roots_in_unit_interval(vanishing_at_root(r)).front().enclosure();
}

// Of all roots in their one gap. Returns the number of parts that were counted over.
int expect_isolated(const std::vector<RationalRoot>& roots, const Polynomial& others) {
  const Polynomial f = product_over(roots) * others;
  const TimeEnclosure gap = gap_around(roots.front());
  std::vector<IsolatedRoot> found;
  const int counted = isolate_in_gap(f, gap, Roots::all, found);
  EXPECT_EQ(found.size(), roots.size());
  if (found.size() != roots.size()) return counted;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_EQ(found[i].doubles, gap);
    const Polynomial there = vanishing_at_root(roots[i]);
    if (found[i].is_time()) {
      EXPECT_EQ(there.sign_at(found[i].lo), 0) << i;
    } else {
      EXPECT_EQ(there.sign_at(found[i].lo), -1) << i;
      EXPECT_EQ(there.sign_at(found[i].hi), 1) << i;
    }
  }
  // And as the roots of the whole interval, in the order given.
  const auto all = roots_in_unit_interval(f);
  std::size_t next = 0;
  for (const auto& root : all) {
    if (next < roots.size() && root.sign_of(vanishing_at_root(roots[next])) == 0) {
      EXPECT_EQ(root.enclosure(), gap);
      for (std::size_t i = 0; i < roots.size(); ++i)
        EXPECT_EQ(root.sign_of(vanishing_at_root(roots[i])), i < next ? 1 : i > next ? -1 : 0);
      ++next;
    }
  }
  EXPECT_EQ(next, roots.size());
  return counted;
}

// 4 log2(s) steps of at most six counts, for each cluster of clusters, and some to begin with.
int most_counts(int bits, int clusters) {
  return clusters * (24 * static_cast<int>(std::ceil(std::log2(bits))) + 24);
}

const Polynomial nothing_else = Polynomial::constant(1);

struct Place {
  const char* name;
  RationalRoot root;
};

std::vector<Place> places() {
  return {{"next to 0", dyadic_root(1, 1100)},
          {"next to 1", double_root(1 - 0x1p-53) + dyadic_root(1, 58)},
          {"next to 0.3", double_root(0.3) + dyadic_root(1, 60)},
          {"in the middle of a gap", fraction(1, 3)},
          {"behind a power of two", double_root(0.25) + dyadic_root(3, 59)}};
}

TEST(RootCluster, TakesFewStepsForAnyDistance) {
  for (const auto& place : places()) {
    for (const int bits : {60, 61, 75, 100, 300, 1000, 1999, 2000}) {
      const int below = place.root.denominator > (Integer(1) << 1000u) ? 1100 : 0;
      const std::vector<RationalRoot> two = {place.root, place.root + dyadic_root(1, below + bits)};
      const int counted = expect_isolated(two, nothing_else);
      EXPECT_LE(counted, most_counts(bits, 1)) << place.name << ", 2^-" << bits;
    }
  }
}

TEST(RootCluster, TellsThreeRootsAtTwoScalesApart) {
  for (const auto& place : places()) {
    const int below = place.root.denominator > (Integer(1) << 1000u) ? 1100 : 0;
    for (const auto& [near, far] : {std::pair{2000, 70}, {2000, 1000}, {300, 299}, {900, 80}}) {
      for (const bool first : {false, true}) {
        const RationalRoot a = place.root, c = a + dyadic_root(1, below + far);
        const RationalRoot b = (first ? a : c) + dyadic_root(first ? 1 : -1, below + near);
        const int counted = expect_isolated({a, b, c}, nothing_else);
        EXPECT_LE(counted, most_counts(near, 2)) << place.name << " " << near << " " << far;
      }
    }
  }
}

// What cannot be seen between doubles but is near: roots at the ends of the gap, in the next one,
// two complex ones beside the cluster.
TEST(RootCluster, OtherRootsNearbyDoNotMatter) {
  const RationalRoot a = double_root(0.3) + dyadic_root(1, 60);
  const Polynomial ends =
      vanishing_at_root(double_root(0.3)) * vanishing_at_root(double_root(std::nextafter(0.3, 1)));
  const Polynomial before = vanishing_at_root(double_root(0.3) + dyadic_root(-1, 70));
  // (t - a)^2 + 2^-400, in integers
  const Polynomial t_a = vanishing_at_root(a + dyadic_root(1, 300));
  const Integer d = a.denominator << 300u;
  const Polynomial complex =
      Polynomial::constant(Integer(1) << 400u) * t_a * t_a + Polynomial::constant(d * d);
  for (const Polynomial& others : {ends, before, complex}) {
    for (const int bits : {70, 500, 2000}) {
      const int counted = expect_isolated({a, a + dyadic_root(1, bits)}, others);
      EXPECT_LE(counted, most_counts(bits, 2)) << bits;
    }
  }
}

// A root where a part is split is a root to report, in its place.
TEST(RootCluster, ReportsRootsAtSplits) {
  const double lo = 0.5, hi = std::nextafter(0.5, 1);
  const RationalRoot half = double_root(lo), middle = half + dyadic_root(1, 54);
  ASSERT_EQ(gap_around(middle), (TimeEnclosure{lo, hi}));
  for (const int bits : {55, 56, 57, 90, 400}) {
    expect_isolated({middle + dyadic_root(-1, bits), middle, middle + dyadic_root(1, bits)},
                    nothing_else);
    expect_isolated({middle, middle + dyadic_root(1, bits)}, nothing_else);
    expect_isolated({half + dyadic_root(1, bits), half + dyadic_root(3, bits)}, nothing_else);
  }
}

TEST(RootCluster, AnyRootWillDo) {
  const RationalRoot a = fraction(1, 3);
  const Polynomial f = product_over({a, a + dyadic_root(1, 500), a + dyadic_root(1, 400)});
  std::vector<IsolatedRoot> found;
  isolate_in_gap(f, gap_around(a), Roots::any, found);
  EXPECT_EQ(found.size(), 1u);
  EXPECT_TRUE(has_root_in_unit_interval(f));
}

// Random polynomials with known roots. A failure prints the least case and how to reproduce it.

RC_GTEST_PROP(RealRootProperty, ProductsOfFactorsHaveTheirRoots, ()) {
  std::vector<RationalRoot> expected;
  for (auto n = *rc::gen::inRange<std::size_t>(1, 6); n > 0; --n)
    expected.push_back({*rc::gen::inRange(-6, 19), *rc::gen::inRange(1, 13)});
  Polynomial f = Polynomial::constant(*rc::gen::element(-3, 1, 7));
  for (const auto& root : expected) f = f * vanishing_at_root(root);
  std::erase_if(expected, [](const auto& r) { return r < fraction(0, 1) || fraction(1, 1) < r; });
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());

  const auto found = roots_in_unit_interval(f);
  RC_ASSERT(found.size() == expected.size());
  RC_ASSERT(has_root_in_unit_interval(f) == !expected.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    RC_ASSERT(found[i].sign_of(vanishing_at_root(expected[i])) == 0);
    const double value =
        expected[i].numerator.convert_to<double>() / expected[i].denominator.convert_to<double>();
    RC_ASSERT(found[i].enclosure().lo <= value);
    RC_ASSERT(value <= found[i].enclosure().hi);
    for (const auto& other : expected) {
      const int sign = found[i].sign_of(vanishing_at_root(other));
      RC_ASSERT(sign == (other < expected[i]) - (expected[i] < other));
    }
  }
}

// Coefficients without any order in them: roots that are no fractions, multiple ones by squares.
RC_GTEST_PROP(RealRootProperty, CountsAndSignsAreThoseOfRemainderSequences, ()) {
  const auto draw = [](std::size_t most) {
    const int reach = *rc::gen::element(1, 3, 20, 1000000);
    Polynomial p;
    for (auto n = *rc::gen::inRange<std::size_t>(1, most + 2); n > 0; --n)
      p = p * Polynomial::linear(0, 1) + Polynomial::constant(*rc::gen::inRange(-reach, reach + 1));
    return p;
  };
  Polynomial f = draw(3);
  if (*rc::gen::arbitrary<bool>()) f = f * draw(2);
  if (*rc::gen::inRange(0, 4) == 0) f = f * f;
  const Dyadic zero = Dyadic::of(0), one = Dyadic::of(1);
  RC_PRE(!f.is_zero() && f.sign_at_zero() != 0 && f.sign_at_one() != 0);
  const auto roots = roots_in_unit_interval(f);
  RC_ASSERT(static_cast<int>(roots.size()) == tests::number_of_roots(f, zero, one));
  RC_ASSERT(has_root_in_unit_interval(f) == !roots.empty());
  const Polynomial q = draw(2);
  int sum = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    sum += roots[i].sign_of(q);
    const auto [lo, hi] = roots[i].enclosure();
    if (i > 0) RC_ASSERT(roots[i - 1].enclosure().hi <= hi);
    if (lo == hi) {
      RC_ASSERT(f.sign_at(Dyadic::of(lo)) == 0);
    } else {
      RC_ASSERT(hi == std::nextafter(lo, 2.0));
    }
  }
  RC_ASSERT(sum == tests::tarski_query(f, q, zero, one));
}

}  // namespace
}  // namespace assay::detector
