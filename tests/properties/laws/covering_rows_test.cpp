#include <gtest/gtest.h>

#include <set>

#include "properties/laws/options/drawn_options.h"

namespace assay::properties {
namespace {

const FactorSizes sizes = {7, 2, 3, 2, 3, 5, 2, 3, 3};

// How many pairs of values of these factors stand together.
std::size_t pairs_of(const std::vector<FactorRow>& rows, std::size_t f, std::size_t g) {
  std::set<std::pair<int, int>> together;
  for (const auto& row : rows) together.emplace(row[f], row[g]);
  return together.size();
}

TEST(CoveringRows, HoldEveryTwoValuesOfEveryTwoFactors) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const auto rows = covering_rows(sizes, seed);
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      for (const auto& row : rows) EXPECT_LT(row[f], sizes[f]);
      for (std::size_t g = 0; g < f; ++g)
        EXPECT_EQ(pairs_of(rows, f, g), std::size_t{sizes[f]} * sizes[g]) << f << " and " << g;
    }
    // No fewer than the two largest factors need, and not many more.
    EXPECT_GE(rows.size(), 35u);
    EXPECT_LE(rows.size(), 45u);
  }
}

TEST(CoveringRows, HoldNoTwoValuesThatMayNotMeet) {
  // The last value of the last factor goes only with the first value of the first one.
  const auto may_meet = [](const TwoValues& two) {
    return two.f != 0 || two.g != 8 || two.b != 2 || two.a == 0;
  };
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const auto rows = covering_rows(sizes, seed, may_meet);
    EXPECT_EQ(pairs_of(rows, 0, 8), 7u * 2 + 1);
    EXPECT_EQ(pairs_of(rows, 5, 8), 15u);
    EXPECT_EQ(pairs_of(rows, 0, 5), 35u);
  }
}

TEST(CoveringRows, AreThoseOfTheirSeed) {
  EXPECT_EQ(covering_rows(sizes, 3), covering_rows(sizes, 3));
  EXPECT_NE(covering_rows(sizes, 3), covering_rows(sizes, 4));
}

}  // namespace
}  // namespace assay::properties
