// `assay shrink` and `assay list`.
#include "corpus/cases/case_file.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Shrink : public testing::Test {
 protected:
  // A case of more than 12 triangles that collides.
  std::string large_case() const {
    for (int i = 0; i < 100; ++i) {
      const std::string id = "tiny:1:closed-generic:" + std::to_string(i);
      const std::string folder = scratch / "exported";
      const auto outcome = run_assay("replay " + id + " --export " + folder);
      const auto c = corpus::read_case(folder + "/case.json");
      if (contains(outcome.out, "oracle collision") && c.value().triangles.rows() > 12)
        return folder + "/case.json";
    }
    ADD_FAILURE() << "no such case";
    return "";
  }
  const Scratch scratch;
};

TEST_F(Shrink, AFailingCaseBecomesSmall) {
  const std::string file = large_case(), small = scratch / "small.json";
  const auto outcome = expect_ended(
      "shrink " + file + " --out " + small + " --time 5 --detector " + plugin("always_free"), 1,
      {"free-sound: answered free", "writes " + small, " -> "});
  const auto before = corpus::read_case(file), after = corpus::read_case(small);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_LT(after.value().triangles.rows(), before.value().triangles.rows());
  const auto lines = replay_lines(outcome.out);
  ASSERT_EQ(lines.size(), 1u);
  expect_ended(lines[0], 1, {"DEFECT free-sound: answered free"});
}

TEST_F(Shrink, WithNextToNoTimeTheCaseItselfIsTheBest) {
  const std::string file = large_case(), small = scratch / "small.json";
  expect_ended(
      "shrink " + file + " --out " + small + " --time 0.000001 --detector " + plugin("always_free"),
      1, {"the time was over"});
  EXPECT_EQ(run_assay("replay " + small + " --detector " + plugin("always_free")).exit_code, 1);
}

TEST_F(Shrink, ACaseThatHoldsSaysSo) {
  const std::string small = scratch / "small.json";
  expect_ended("shrink " + curated("A4_endpoints_only") + " --out " + small, 0,
               {"nothing to shrink"});
  EXPECT_FALSE(std::filesystem::exists(small));
}

TEST_F(Shrink, BadInputIsOneLine) {
  const std::string file = curated("A4_endpoints_only"), small = scratch / "small.json";
  expect_refused("shrink " + file, "--out");
  expect_refused("shrink /nowhere.json --out " + small, "/nowhere.json");
  expect_refused("shrink " + scratch.write("bad.json", "[]") + " --out " + small, "bad.json");
  expect_refused("shrink " + file + " --out /nowhere/small.json", "/nowhere");
  expect_refused("shrink " + file + " --out " + (scratch / ""), "directory");
  expect_refused("shrink " + file + " --out " + small + " --time 0", "--time");
  expect_refused("shrink " + file + " --out " + small + " --detector " + file,
                 "not a detector plug-in");
  // A case is never overwritten by what became of it.
  const auto copy = scratch.write("copy.json", read_text(file));
  expect_refused("shrink " + copy + " --out " + copy, "is an input too");
  EXPECT_EQ(read_text(copy), read_text(file));
}

TEST(List, LawsFaultsAndCampaigns) {
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
  for (const std::string name : {"smoke", "quick", "nightly", "release"}) {
    EXPECT_TRUE(contains(campaigns.out, name + " ")) << campaigns.out;
  }
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
