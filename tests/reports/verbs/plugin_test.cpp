// `assay check --detector`: a plug-in through the command line, as its owner runs it.
#include <sys/stat.h>

#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using json = nlohmann::ordered_json;

class Plugin : public testing::Test {
 protected:
  // On a scene that collides or one that does not, with a report.
  static Outcome check(const std::string& name, bool collides, const std::string& more = "") {
    return run_assay("check --detector " + plugin(name) + " --json " + (scratch / "report.json") +
                     " " + (collides ? colliding : free) + " " + more);
  }
  static json report() { return read_json(scratch / "report.json"); }

  static inline const Scratch scratch;
  static inline const std::string colliding = make_scene(scratch, "folding-sheet", 200, 5);
  static inline const std::string free = make_scene(scratch, "breathing-sphere", 200, 5);
};

TEST_F(Plugin, TheBuiltInHoldsAsAPlugIn) {
  expect_ended(check("wrapped_builtin", true), 0,
               {"plug-in built-in as a plug-in 1", "all claims hold"});
  EXPECT_EQ(check("wrapped_builtin", true, "--fail-on-collision").exit_code, 5);
  EXPECT_EQ(report()["outcome"], "holds");
  EXPECT_EQ(report()["culling"], nullptr);
  EXPECT_EQ(report()["detector"]["claims"].size(), 12u);
  EXPECT_EQ(report()["detector"]["contract"]["adjacency"], "all");
}

TEST_F(Plugin, WhatItsContractLeavesOutIsSaid) {
  expect_ended(check("example", true), 0,
               {"contract: neighbours no-shared-vertex", "collision at t = [0, 1] of step"});
  EXPECT_EQ(report()["steps"][0]["first_time"], json::array({0, 1}));
}

TEST_F(Plugin, ABrokenClaimIsNamed) {
  expect_ended(check("always_free", true), 1, {"broken: free-sound first-pairs all-pairs"});
  const auto steps = report()["steps"];
  EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [](const json& step) {
    return step["diff"]["broken"] == json::array({"free-sound", "first-pairs", "all-pairs"});
  }));
  expect_ended(check("always_collision", false), 1, {"broken: no-spurious"});
}

TEST_F(Plugin, ACrashAndARefusalAreDefectsAHangIsUndecided) {
  expect_ended(check("exit", true), 1, {"DEFECT: exited with code 0; broken: total"});
  EXPECT_EQ(report()["outcome"], "defect");
  EXPECT_EQ(report()["detector_ended"], "exited with code 0; broken: total");
  expect_ended(check("refuse", true), 1, {"too many triangles"});
  expect_ended(check("hang", true, "--time 0.3"), 3, {"undecided: no answer in 0.3 s"});
}

TEST_F(Plugin, AStepWithoutAnAnswerBreaksTotal) {
  expect_ended(check("fail", true), 1, {"step 1: evaluate returned 3"});
  EXPECT_EQ(report()["steps"][0]["diff"]["broken"], json::array({"total"}));
}

TEST_F(Plugin, CaseFilesAreRunByTheirScript) {
  for (const std::string name : {"B1_one_vertex_own_nearest", "D8_release_arm_sequence"})
    expect_ended("check --detector " + plugin("wrapped_builtin") + " " + curated(name), 0);
}

TEST_F(Plugin, WhatCannotBeUsedIsRefusedInOneLine) {
  const auto words = "check " + free + " ";
  expect_refused(words + "--detector /nowhere/lib.so", "/nowhere/lib.so: no such file");
  expect_refused(words + "--detector " ASSAY_SOURCE_DIR "/README.md", "not a detector plug-in");
  const std::string pipe = scratch / "pipe.so";
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  expect_refused(words + "--detector " + pipe, "not a detector plug-in: not a file");
  expect_refused(words + "--detector " + plugin("without_entry"), "exports no assay_detector()");
  expect_refused(words + "--detector " + plugin("wrong_abi"), "built for ABI version 99");
}

}  // namespace
}  // namespace assay::tests
