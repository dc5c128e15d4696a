#include "oracle/query/times/common_factor.h"

#include <gtest/gtest.h>

namespace assay::oracle {
namespace {

// Equal up to a factor.
void expect_alike(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  ASSERT_EQ(a.degree(), b.degree());
  const IntegerPolynomial x = a * IntegerPolynomial{{b.c.back()}};
  const IntegerPolynomial y = b * IntegerPolynomial{{a.c.back()}};
  EXPECT_TRUE((x - y).is_zero());
}

const IntegerPolynomial third = {{-1, 3}}, half = {{-1, 2}}, root = {{-1, 0, 2}};

TEST(CommonFactor, OfProducts) {
  expect_alike(common_factor(third * root, half * third), third);
  expect_alike(common_factor(third * root, root * IntegerPolynomial{{-6}}), root);
  expect_alike(common_factor(root, third * root), root);
  expect_alike(common_factor(half * half * third, half * half), half * half);
  EXPECT_EQ(common_factor(third * root, half).degree(), 0);
  EXPECT_EQ(common_factor(third, IntegerPolynomial{{5}}).degree(), 0);
}

TEST(CommonFactor, HasNoCommonDivisorOfItsCoefficients) {
  const IntegerPolynomial hundred = {{100}};
  const IntegerPolynomial g = common_factor(half * hundred * third, half * hundred);
  EXPECT_EQ(abs(g.c.back()), 2);
}

TEST(Cofactor, IsWhatIsLeft) {
  expect_alike(cofactor(third * root, third), root);
  expect_alike(cofactor(third * root, root), third);
  expect_alike(cofactor(third * half * half, half), third * half);
  EXPECT_EQ(cofactor(root, root).degree(), 0);
}

}  // namespace
}  // namespace assay::oracle
