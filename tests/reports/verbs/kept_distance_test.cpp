// Detectors that keep a distance: the right one holds; of each wrong one a campaign finds a case,
// shrinks it to two triangles, and names the distance as its cause.
#include <nlohmann/json.hpp>

#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// tests/plugins/keeps_distance.cpp says what the words are.
class KeptDistance : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out";

  Outcome run(const std::string& words, const std::string& more = "") const {
    return run_assay("run --campaign " + scratch.write("plan.json", plan_text(16)) + " --out " +
                         out + " --time 600 --detector " + plugin("keeps_distance") + " " + more,
                     "ASSAY_KEEPS_DISTANCE=\"separation=0.01 " + words + "\" ");
  }
};

TEST_F(KeptDistance, TheOraclesOwnAnswersHold) {
  const auto ran = run("");
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_TRUE(contains(ran.out, "contract: neighbours no-shared-vertex, within 0.01")) << ran.out;
}

TEST_F(KeptDistance, TheBuiltInDetectorsAnswersHold) {
  const auto ran = run("ours");
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
}

TEST_F(KeptDistance, OneThatAlarmsWithinASlackSaysSo) {
  EXPECT_EQ(run("squares-it margin=0.2").exit_code, 0);
  std::filesystem::remove_all(out);
  EXPECT_EQ(run("squares-it margin=0.01").exit_code, 1);
}

TEST_F(KeptDistance, EachFaultIsFoundAndShrunkToTwoTriangles) {
  for (const std::string fault : {"ignores-it", "squares-it", "half-boxes", "no-edges"}) {
    std::filesystem::remove_all(out);
    const auto ran = run(fault);
    EXPECT_EQ(ran.exit_code, 1) << fault << ran.out << ran.err;
    int named = 0;
    for (const auto& [signature, count] : signatures_of(out))
      named += contains(signature, "distance") ? 1 : 0;
    EXPECT_GT(named, 0) << fault;
    EXPECT_EQ(triangles_of_smallest(out), 2) << fault;
  }
}

}  // namespace
}  // namespace assay::tests
