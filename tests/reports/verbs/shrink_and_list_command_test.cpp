// `assay shrink` and `assay list`.
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Shrink : public testing::Test {
 protected:
  const Scratch scratch;
  // It collides, and has 14 triangles.
  const std::string file = curated("D6_fast_passage"), small = scratch / "small.json";
};

TEST_F(Shrink, AFailingCaseBecomesSmall) {
  const auto outcome = expect_ended(
      "shrink " + file + " --out " + small + " --time 5 --detector " + plugin("always_free"), 1,
      {"free-sound: answered free", "writes " + small, " -> "});
  EXPECT_LT(read_json(small)["triangles"].size(), read_json(file)["triangles"].size());
  const auto lines = replay_lines(outcome.out);
  ASSERT_EQ(lines.size(), 1u);
  expect_ended(lines[0], 1, {"DEFECT free-sound: answered free"});
}

TEST_F(Shrink, WithNextToNoTimeTheCaseItselfIsTheBest) {
  expect_ended(
      "shrink " + file + " --out " + small + " --time 0.000001 --detector " + plugin("always_free"),
      1, {"the time was over"});
  EXPECT_EQ(run_assay("replay " + small + " --detector " + plugin("always_free")).exit_code, 1);
}

TEST_F(Shrink, ACaseThatHoldsSaysSo) {
  expect_ended("shrink " + curated("A4_endpoints_only") + " --out " + small, 0,
               {"nothing to shrink"});
  EXPECT_FALSE(std::filesystem::exists(small));
}

TEST_F(Shrink, BadInputIsOneLine) {
  expect_refused("shrink " + file, "--out");
  expect_refused("shrink /nowhere.json --out " + small, "/nowhere.json");
  expect_refused("shrink " + scratch.write("bad.json", "[]") + " --out " + small, "bad.json");
  expect_refused("shrink " + file + " --out " + small + " --time 0", "--time");
  // A case is never overwritten by what became of it.
  const auto copy = scratch.write("copy.json", read_text(file));
  expect_refused("shrink " + copy + " --out " + copy, "is an input too");
  EXPECT_EQ(read_text(copy), read_text(file));
}

TEST(List, LawsFaultsScenesAndCampaigns) {
  expect_ended("list scenes", 0, {"arm-in-box"});
  const auto laws = expect_ended("list laws", 0);
  for (const auto& law : properties::laws()) {
    EXPECT_TRUE(contains(laws.out, std::string(law.name) + "\n")) << law.name;
    EXPECT_TRUE(contains(laws.out, std::string(law.statement))) << law.name;
  }
  const auto faults = expect_ended("list faults", 0);
  std::set<std::string> planted;
  for (const auto& fault : properties::faults()) {
    EXPECT_TRUE(contains(faults.out, std::string(fault.name) + " ")) << fault.name;
    if (fault.status == properties::FaultStatus::planted) planted.insert(std::string(fault.name));
  }
  EXPECT_GE(planted.size(), 40u);
  const auto campaigns = expect_ended("list campaigns", 0);
  for (const std::string name : {"smoke", "quick", "nightly", "release"})
    EXPECT_TRUE(contains(campaigns.out, name + " ")) << campaigns.out;
}

TEST(List, FailuresNeedARun) {
  const Scratch scratch;
  expect_refused("list failures", "folder of a run");
  expect_refused("list failures /nowhere", "/nowhere");
  expect_refused("list failures " + (scratch / ""), "no run is stored here");
  expect_refused("list laws " + (scratch / ""), "takes no folder");
  expect_refused("list errors", "errors");
  scratch.write("run.sqlite", "");
  expect_refused("list failures " + (scratch / ""), "not the store of a run");
}

}  // namespace
}  // namespace assay::tests
