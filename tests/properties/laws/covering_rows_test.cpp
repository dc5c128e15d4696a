#include "properties/laws/option_laws.h"

#include <gtest/gtest.h>

#include <set>

namespace assay::properties {
namespace {

constexpr FactorSizes sizes = {7, 2, 3, 2, 3, 5, 2, 3, 3};

TEST(CoveringRows, HoldEveryTwoValuesOfEveryTwoFactors) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const auto rows = covering_rows(sizes, seed);
    for (std::size_t f = 0; f < option_factors; ++f) {
      for (std::size_t g = 0; g < f; ++g) {
        std::set<std::pair<int, int>> together;
        for (const auto& row : rows) {
          EXPECT_LT(row[f], sizes[f]);
          together.emplace(row[f], row[g]);
        }
        EXPECT_EQ(together.size(), std::size_t{sizes[f]} * sizes[g]) << f << " and " << g;
      }
    }
    // No fewer than the two largest factors need, and not many more.
    EXPECT_GE(rows.size(), 35u);
    EXPECT_LE(rows.size(), 45u);
  }
}

TEST(CoveringRows, AreThoseOfTheirSeed) {
  EXPECT_EQ(covering_rows(sizes, 3), covering_rows(sizes, 3));
  EXPECT_NE(covering_rows(sizes, 3), covering_rows(sizes, 4));
}

}  // namespace
}  // namespace assay::properties
