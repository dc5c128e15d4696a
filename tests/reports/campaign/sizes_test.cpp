// Strata of sizes through the program. A failure on large meshes alone is found, and reported with
// the number of triangles from which it occurs. No size above the judged ones is certified.
// Refusals beyond a stated capacity are counted, and break no claim.
#include "properties/campaign/gates/gates.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using properties::Claim;

class Sizes : public RunFixture {
 protected:
  // A campaign of strata of sizes alone, with so many seconds to shrink what fails.
  std::string campaign(const std::string& strata, int shrinking) const {
    return scratch.write(
        "sizes.json", R"({"schema": "assay-campaign/1", "name": "sizes", "seconds": 600, )"
                      R"("shrink_share": )" +
                          std::to_string(shrinking / 600.) + R"(, "laws_every": 0, "strata": [)" +
                          strata + "]}");
  }
  static std::string stratum(const std::string& family, int cases) {
    return R"({"family": ")" + family + R"(", "cases": )" + std::to_string(cases) + "}";
  }
  Outcome run_on(const std::string& strata, const std::string& more = "", int shrinking = 0) const {
    return run_assay("run --campaign " + campaign(strata, shrinking) + " --out " + out +
                     " --jobs 2 " + more);
  }
  properties::RunFindings findings() const { return properties::read_findings(out).value(); }
};

TEST_F(Sizes, TheBuiltInHoldsAndTheSizeIsSaid) {
  const auto outcome = expect_ended(run_on(stratum("size-1e3", 4)), 0);
  const auto sizes = judged_sizes(findings());
  EXPECT_FALSE(sizes.empty());
  for (const auto& [claim, triangles] : sizes) {
    EXPECT_NE(claim, "progress") << "nothing asked for a limit";
    EXPECT_GE(triangles, 900u) << claim;
    EXPECT_TRUE(contains(outcome.out, claim)) << claim;
  }
  EXPECT_GE(largest_tried(findings()).triangles, 900u);
  EXPECT_TRUE(contains(outcome.out, "\nlargest tried: ")) << outcome.out;
}

TEST_F(Sizes, FreeAbove5000IsFoundAt10000AndTheNumberIsTold) {
  expect_ended(run_on(stratum("size-1e3", 2) + ", " + stratum("size-1e4", 1),
                      "--detector " + plugin("free_above_5000"), 120),
               1, {"fails from 5001 triangles on"});
  EXPECT_EQ(triangles_of_smallest(out), 5001);
}

TEST_F(Sizes, FreeAbove50000IsFoundAt100000) {
  expect_ended(run_on(stratum("size-1e5", 1), "--detector " + plugin("free_above_50000"), 300), 1,
               {"fails from 50001 triangles on"});
}

TEST_F(Sizes, ADeepTreeIsFoundAt1000AndComesHomeSmall) {
  expect_ended(run_on(stratum("size-1e3", 3), "--detector " + plugin("stack_of_32_levels"), 15), 1);
  EXPECT_LE(triangles_of_smallest(out), 400);
}

TEST_F(Sizes, BuffersAndProductsAreFoundAt10000) {
  for (const auto* wrong : {"buffer_of_candidates", "product_in_32_bits"}) {
    std::filesystem::remove_all(out);
    SCOPED_TRACE(wrong);
    expect_ended(run_on(stratum("size-1e4", 4), "--detector " + plugin(wrong)), 1, {"large mesh"});
  }
}

// The same refusals hold under a contract that names them, and break `total` under one that does
// not.
TEST_F(Sizes, RefusalsBeyondTheCapacityAreCounted) {
  const auto with = [&](const std::string& words) {
    std::filesystem::remove_all(out);
    setenv("ASSAY_BY_CONTRACT", words.c_str(), 1);
    auto outcome = run("--detector " + plugin("by_contract"));
    unsetenv("ASSAY_BY_CONTRACT");
    return outcome;
  };
  expect_ended(with("refuse-from=20 capacity-triangles=19"), 0,
               {"`refused: capacity` in ", "capacity 19 triangles"});
  const auto f = findings();
  EXPECT_GT(f.tally.counts.measures.refused, 0u);
  for (const auto& [claim, triangles] : judged_sizes(f)) EXPECT_LT(triangles, 20u) << claim;
  EXPECT_LT(largest_tried(f).triangles, 20u);
  EXPECT_GT(largest_tried(f).triangles, 0u);

  EXPECT_EQ(with("refuse-pairs-from=9 capacity-contacts=8").exit_code, 0);
  expect_ended(with("refuse-from=20"), 1, {"total: refused: capacity"});
  expect_ended(with("refuse-pairs-from=8 capacity-contacts=8"), 1, {"8 contacts (it holds 8)"});
  // Silence is no refusal.
  EXPECT_EQ(with("miss-inside capacity-triangles=3").exit_code, 1);
}

}  // namespace
}  // namespace assay::tests
