// Nights are pooled under equal digests only.
#include "properties/campaign/gates/statistics.h"
#include "reports/certificate/verify.h"
#include "tests/problem_words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json night(std::uint64_t seed, std::uint64_t n, std::uint64_t holds) {
  return {{"detector", {{"name", "d"}}},
          {"digests", {{"program", "p"}, {"worker", "w"}, {"plugin", nullptr}, {"generator", "g"}}},
          {"campaign", {{"name", "nightly"}, {"seed", seed}}},
          {"confidence", {{"bounds", 8}, {"risk_of_each", properties::risk_of_each(8)}}},
          {"strata",
           {{{"family", "broken"},
             {"risk", properties::risk_of_each(8)},
             {"bounds", {{{"configuration", "bvh"}, {"n", n}, {"holds", holds}}}}}}}};
}

TEST(Pooling, NightsOfOneDetectorAddUp) {
  const auto pooled = pool({night(1, 100, 100), night(2, 300, 299)});
  ASSERT_TRUE(pooled) << pooled.error().message;
  ASSERT_EQ(pooled.value().size(), 1u);
  const auto& row = pooled.value()[0];
  EXPECT_EQ(row["family"], "broken");
  EXPECT_EQ(row["configuration"], "bvh");
  EXPECT_EQ(row["n"], 400);
  EXPECT_EQ(row["holds"], 399);
  EXPECT_EQ(row["bound"], properties::upper_bound(1, 400, properties::risk_of_each(8)));
}

TEST(Pooling, OfDifferentDigestsIsRefused) {
  for (const char* place :
       {"/digests/program", "/digests/worker", "/digests/plugin", "/digests/generator",
        "/detector/name", "/confidence/bounds", "/strata/0/family"}) {
    Json other = night(2, 100, 100);
    other[Json::json_pointer(place)] = "other";
    const auto pooled = pool({night(1, 100, 100), other});
    ASSERT_FALSE(pooled) << place;
    EXPECT_TRUE(says(pooled.error(), "cannot be pooled: the"));
  }
}

TEST(Pooling, NoTrialCountsTwice) {
  const auto pooled = pool({night(1, 100, 100), night(2, 100, 100), night(1, 50, 50)});
  ASSERT_FALSE(pooled);
  EXPECT_TRUE(says(pooled.error(), "seed 1 is there twice"));
}

}  // namespace
}  // namespace assay::reports
