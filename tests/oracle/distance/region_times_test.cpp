// Zeros of regions with the conditions at them: for polynomials whose zeros are known, and against
// CGAL's algebraic kernel.
#include <gtest/gtest.h>

#include <optional>

#include "oracle/distance/regions.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/algebraic_times.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

IntegerPolynomial product_of(const std::vector<IntegerPolynomial>& factors) {
  IntegerPolynomial p{{1}};
  for (const IntegerPolynomial& f : factors) p = p * f;
  return p;
}

const IntegerPolynomial third{{-1, 3}}, two_thirds{{-2, 3}}, root_of_half{{-1, 0, 2}};

TEST(CommonDivisor, OfKnownZeros) {
  const IntegerPolynomial imaginary{{1, 0, 1}};
  const IntegerPolynomial p = product_of({third, third, two_thirds, imaginary});
  const auto expect = [](const IntegerPolynomial& found, const IntegerPolynomial& expected) {
    EXPECT_TRUE(found.c == expected.c || found.c == (-expected).c);
  };
  expect(common_divisor(p, derivative(p)), third);
  expect(common_divisor(derivative(p), p), third);
  expect(common_divisor(p, product_of({root_of_half, two_thirds, imaginary})),
         two_thirds * imaginary);
  expect(common_divisor(p, root_of_half), {{1}});
  expect(common_divisor(p, {{7}}), {{1}});
  expect(common_divisor(p, p), p);
  expect(quotient(p, third), product_of({third, two_thirds, imaginary}));
  // The first prime that is tried divides leading coefficients, or a resultant: no matter.
  const Integer prime = (Integer(1) << 30) + 3;
  const IntegerPolynomial of_prime{{-1, prime}}, near_third{{Integer(-1 - prime), 3}};
  expect(common_divisor(p * of_prime, of_prime * root_of_half), of_prime);
  expect(common_divisor(p * of_prime, root_of_half), {{1}});
  expect(common_divisor(third, near_third), {{1}});
}

// More primes are needed than one, and coefficients are negative, too.
TEST(CommonDivisor, OfLongCoefficients) {
  const Integer big = (Integer(1) << 5000) + 7;
  const IntegerPolynomial common{{-big, Integer(3 * big + 1), Integer(-5 * big)}};
  const IntegerPolynomial found =
      common_divisor(common * third * IntegerPolynomial{{big}}, common * common * root_of_half);
  EXPECT_TRUE(found.c == common.c || found.c == (-common).c);
  EXPECT_EQ(quotient(common * third, common).c, third.c);
}

TEST(CommonDivisor, PiecesOfAPolynomial) {
  EXPECT_EQ(on_piece(third, 0.25, 0.5).c, (std::vector<Integer>{-1, 3}));  // 3/4 + 3/4 x - 1
  EXPECT_EQ(on_piece(third, 0.5, 0.25).c, (std::vector<Integer>{2, -3}));
  EXPECT_EQ(on_piece(root_of_half, 0, 0.5).c, (std::vector<Integer>{-2, 0, 1}));
}

// Both zeros, 1/3 and that beside it, are between the same two doubles.
TEST(RegionTimes, ClustersBetweenDoubles) {
  const Integer big = Integer(1) << 200;
  const IntegerPolynomial beside{{Integer(-3 * big - 1), Integer(9 * big)}};
  const IntegerPolynomial both = third * beside;
  // Between the zeros, at 1/3 + 1/(18 2^200), this changes its sign.
  const IntegerPolynomial between{{Integer(-6 * big - 1), Integer(18 * big)}};
  const double lo = 1.0 / 3, hi = std::nextafter(lo, 1);
  const auto expected = std::optional(detector::TimeEnclosure{lo, hi});
  EXPECT_EQ(first_zero({both, {between}}, 0, 1), expected);
  EXPECT_EQ(first_zero({both, {-between}}, 0, 1), expected);
  EXPECT_EQ(first_zero({both, {between, third}, {{1}}}, 0, 1), expected);
  EXPECT_FALSE(first_zero({both, {between, -third}}, 0, 1));
  EXPECT_FALSE(first_zero({both, {between, -between}}, 0, 1));
  EXPECT_FALSE(first_zero({both, {-between}, third * third}, 0, 1));
  EXPECT_EQ(first_zero({both * both * two_thirds, {-between}}, 0, 1), expected);
}

// Conditions at one zero: shared with it, of it alone, and next to it in 200 bits.
TEST(RegionTimes, ConditionsAtAZero) {
  const double lo = 1.0 / 3, hi = std::nextafter(lo, 1);
  const auto expected = std::optional(detector::TimeEnclosure{lo, hi});
  const Integer big = Integer(1) << 200;
  const IntegerPolynomial beside{{Integer(-3 * big - 1), Integer(9 * big)}};
  EXPECT_EQ(first_zero({third, {third, -third, two_thirds * third}}, 0, 1), expected);
  EXPECT_FALSE(first_zero({third, {two_thirds}}, 0, 1));
  EXPECT_EQ(first_zero({third, {-beside}}, 0, 1), expected);
  EXPECT_FALSE(first_zero({third, {beside}}, 0, 1));
  EXPECT_EQ(first_zero({third, {}, beside * beside}, 0, 1), expected);
  EXPECT_FALSE(first_zero({third, {}, third * third}, 0, 1));
  EXPECT_EQ(first_zero({third * third, {-beside * third * third}}, 0, 1), expected);
  // The second zero, at which alone the conditions hold, and one at an end.
  EXPECT_EQ(first_zero({third * root_of_half, {{{-1, 2}}}}, 0, 1)->hi, std::sqrt(0.5));
  EXPECT_EQ(first_zero({IntegerPolynomial{{1, -1}} * third, {{{-1, 2}}}}, 0, 1),
            std::optional(detector::TimeEnclosure{1, 1}));
  EXPECT_FALSE(first_zero({IntegerPolynomial{{0, 1}}, {}}, 0, 1));  // s itself is not asked for
}

// Zeros below the least double and above the double before 1, told apart by their exponents.
TEST(RegionTimes, ClustersAtTheEndsOfTheStep) {
  const auto near_zero = [](unsigned bits) { return IntegerPolynomial{{-1, Integer(1) << bits}}; };
  const auto near_one = [](unsigned bits) {
    return IntegerPolynomial{{Integer(1 - (Integer(1) << bits)), Integer(1) << bits}};
  };
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(first_zero({near_zero(9000) * near_zero(3000), {-near_zero(8000)}}, 0, 1),
            std::optional(detector::TimeEnclosure{0, least}));
  EXPECT_FALSE(first_zero({near_zero(9000) * near_zero(3000), {-near_zero(9999)}}, 0, 1));
  EXPECT_EQ(first_zero({near_one(9000) * near_one(3000), {near_one(8000)}}, 0, 1),
            std::optional(detector::TimeEnclosure{std::nextafter(1.0, 0), 1}));
  EXPECT_FALSE(first_zero({near_one(9000) * near_one(3000), {near_one(9999)}}, 0, 1));
}

std::optional<detector::TimeEnclosure> first_zero_by_kernel(const Region& region) {
  if (region.f.is_zero()) return {};
  const std::array polynomials = {region.f};
  const AlgebraicTimes times(polynomials);
  for (int i = 0; i < times.size(); ++i) {
    bool hold = times.sign(region.positive, i) > 0;
    for (const IntegerPolynomial& g : region.not_negative) hold = hold && times.sign(g, i) >= 0;
    if (hold) return times.enclosure(i);
  }
  return {};
}

TEST(RegionTimes, AgreeWithTheAlgebraicKernel) {
  test::Random random(16);
  int zeros = 0, even = 0;
  constexpr int queries = 40;
  for (int kind = 0; kind < test::query_kinds; ++kind) {
    for (int i = 0; i < queries; ++i) {
      const int first_group = 1 + i % 2;
      const test::Points x =
          test::random_query(random, static_cast<test::QueryKind>(kind), first_group);
      constexpr double distances[] = {0, 0.5, 1, 2, 3};
      const Separation d = {distances[random.below(5)], random.below(3) == 0 ? 0x1p-70 : 0};
      const Regions regions({x, first_group}, d);
      for (int r = 0; r < regions.size(); ++r) {
        const Region region = regions[r];
        const auto expected = first_zero_by_kernel(region);
        const auto found = first_zero(region, 0, 1);
        // The kernel's first zero may be 0, which first_zero leaves out.
        if (expected && expected->hi == 0) continue;
        ASSERT_EQ(found, expected) << kind << " " << i << " " << r;
        zeros += expected.has_value();
        even += expected && sign_at(derivative(region.f), expected->lo) == 0;
      }
    }
  }
  std::printf("%d zeros, %d of them of even order\n", zeros, even);
  EXPECT_GT(zeros, 300);
  EXPECT_GT(even, 10);
}

}  // namespace
}  // namespace assay::oracle
