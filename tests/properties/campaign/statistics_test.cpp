// The bound of Clopper and Pearson against sums of the binomial distribution, closed forms, and
// values in print.
#include "properties/campaign/ledger/step_measures.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// The chance of at most k failures in n trials, summed term by term.
double chance_of_at_most(std::uint64_t k, std::uint64_t n, double p) {
  double sum = 0;
  for (std::uint64_t i = 0; i <= k; ++i) {
    const auto count = static_cast<double>(i), all = static_cast<double>(n);
    sum += std::exp(std::lgamma(all + 1) - std::lgamma(count + 1) - std::lgamma(all - count + 1) +
                    count * std::log(p) + (all - count) * std::log1p(-p));
  }
  return sum;
}

TEST(UpperBound, OfNoFailureHasAClosedForm) {
  for (const std::uint64_t n : {1u, 2u, 10u, 100u, 4000u, 120'000u}) {
    for (const double risk : {.05, .01, .05 / 48}) {
      const double expected = -std::expm1(std::log(risk) / static_cast<double>(n));
      EXPECT_NEAR(upper_bound(0, n, risk) / expected, 1, 1e-12) << n << " " << risk;
    }
  }
}

TEST(UpperBound, IsTheRuleOfThreeForManyTrials) {
  // -ln 0.05 = 2.9957: three in n, at 95 %.
  EXPECT_NEAR(1e6 * upper_bound(0, 1'000'000, .05), 2.99573, 1e-4);
}

TEST(UpperBound, AgreesWithValuesInPrint) {
  // Two-sided 95 % intervals hold one-sided bounds at 2.5 %. 10 of 100: (0.0490, 0.1762); 0 of 10:
  // 0.3085; 1 of 10: 0.4450; 5 of 10: 0.8129; 1 of 20: 0.2487 (Clopper and Pearson 1934, charts;
  // standard tables).
  constexpr double risk = .025;
  EXPECT_NEAR(upper_bound(10, 100, risk), .1762, 5e-5);
  EXPECT_NEAR(upper_bound(0, 10, risk), .3085, 5e-5);
  EXPECT_NEAR(upper_bound(1, 10, risk), .4450, 5e-5);
  EXPECT_NEAR(upper_bound(5, 10, risk), .8129, 5e-5);
  EXPECT_NEAR(upper_bound(1, 20, risk), .2487, 5e-5);
}

TEST(UpperBound, LeavesExactlyTheRisk) {
  for (const std::uint64_t n : {5u, 50u, 1000u, 20'000u}) {
    for (const std::uint64_t k : {0u, 1u, 2u, 4u}) {
      for (const double risk : {.05, .001}) {
        const double p = upper_bound(k, n, risk);
        EXPECT_NEAR(chance_of_at_most(k, n, p) / risk, 1, 1e-6) << k << " of " << n;
        // A larger share would have had less than that chance.
        EXPECT_LT(chance_of_at_most(k, n, std::min(1., 1.01 * p)), risk);
      }
    }
  }
}

TEST(UpperBound, GrowsWithFailuresFallsWithTrialsAndRisk) {
  for (std::uint64_t k = 0; k < 30; ++k) {
    EXPECT_LT(upper_bound(k, 30, .05), upper_bound(k + 1, 30, .05) + (k == 29 ? 1e-9 : 0)) << k;
  }
  for (std::uint64_t n = 4; n < 200; ++n) {
    EXPECT_GT(upper_bound(3, n, .05), upper_bound(3, n + 1, .05)) << n;
  }
  EXPECT_LT(upper_bound(3, 40, .05), upper_bound(3, 40, .01));
  EXPECT_GT(upper_bound(3, 40, .05), 3. / 40);
}

TEST(UpperBound, OfNothingIsAll) {
  EXPECT_EQ(upper_bound(0, 0, .05), 1);
  EXPECT_EQ(upper_bound(7, 7, .05), 1);
  EXPECT_EQ(upper_bound(1, 1, .05), 1);
  EXPECT_LT(upper_bound(6, 7, .05), 1);
}

TEST(RiskOfEach, SharesTheFamilyRisk) {
  EXPECT_EQ(risk_of_each(0), .05);
  EXPECT_EQ(risk_of_each(1), .05);
  for (const std::uint64_t bounds : {2u, 8u, 48u}) {
    const double each = risk_of_each(bounds);
    EXPECT_NEAR(each * static_cast<double>(bounds), .05, 1e-15);
    // Bonferroni: even independent bounds hold together with at least 95 %.
    EXPECT_GE(std::pow(1 - each, static_cast<double>(bounds)), .95);
  }
}

// What the plans want is in reach of their sizes when nothing fails.
TEST(UpperBound, OfThePlansIsInReach) {
  // At most 24 strata, 10 configurations, at most 8 claims each.
  const double risk = risk_of_each(24 * 10 * 8);
  EXPECT_LE(upper_bound(0, 4000, risk), 5e-3);
  EXPECT_LE(upper_bound(0, 1500, risk), 5e-2);
  EXPECT_LE(upper_bound(0, 20'000, risk), 1e-3);
  EXPECT_LE(upper_bound(0, 60'000, risk), 2e-4);
  EXPECT_GT(upper_bound(0, 1000, risk), 5e-3);
}

}  // namespace
}  // namespace assay::properties
