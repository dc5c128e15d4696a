// `assay check --detector`: a plug-in through the command line, as its owner runs it.
#include <sys/stat.h>

#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using nlohmann::json;

std::string plugin(const std::string& name) {
  return std::string(ASSAY_PLUGIN_DIR) + "/plugin_" + name + ".so";
}

class Plugin : public testing::Test {
 protected:
  static std::string make_scene(const std::string& name) {
    const std::string folder = scratch / name;
    const auto made = run_assay("scene " + name + " --size 200 --frames 5 --out " + folder);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder + "/frame_*.ply";
  }
  // On a scene that collides or one that does not, with a report.
  static Outcome check(const std::string& name, bool collides, const std::string& more = "") {
    return run_assay("check --detector " + plugin(name) + " --json " + (scratch / "report.json") +
                     " " + (collides ? colliding : free) + " " + more);
  }
  static json report() { return json::parse(read_text(scratch / "report.json")); }

  static inline const Scratch scratch;
  static inline const std::string colliding = make_scene("folding-sheet");
  static inline const std::string free = make_scene("breathing-sphere");
};

TEST_F(Plugin, TheBuiltInHoldsAsAPlugIn) {
  const auto outcome = check("wrapped_builtin", true);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("plug-in built-in as a plug-in 1"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("all claims hold"), std::string::npos) << outcome.out;
  EXPECT_EQ(check("wrapped_builtin", true, "--fail-on-collision").exit_code, 5);
  EXPECT_EQ(report()["outcome"], "holds");
  EXPECT_EQ(report()["culling"], nullptr);
  EXPECT_EQ(report()["detector"]["claims"].size(), 12u);
  EXPECT_EQ(report()["detector"]["contract"]["adjacency"], "all");
}

TEST_F(Plugin, WhatItsContractLeavesOutIsSaid) {
  const auto outcome = check("example", true);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(says(outcome.out, "contract: neighbours no-shared-vertex"));
  EXPECT_NE(outcome.out.find("collision at t = [0, 1] of step"), std::string::npos) << outcome.out;
  EXPECT_EQ(report()["steps"][0]["first_time"], json::array({0, 1}));
}

TEST_F(Plugin, ABrokenClaimIsNamed) {
  const auto missed = check("always_free", true);
  EXPECT_EQ(missed.exit_code, 1) << missed.out << missed.err;
  EXPECT_TRUE(says(missed.out, "broken: free-sound first-pairs all-pairs"));
  const auto steps = report()["steps"];
  EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [](const json& step) {
    return step["diff"]["broken"] == json::array({"free-sound", "first-pairs", "all-pairs"});
  }));
  const auto alarm = check("always_collision", false);
  EXPECT_EQ(alarm.exit_code, 1) << alarm.out << alarm.err;
  EXPECT_NE(alarm.out.find("broken: no-spurious"), std::string::npos) << alarm.out;
}

TEST_F(Plugin, ACrashAndARefusalAreDefectsAHangIsUndecided) {
  const auto crash = check("exit", true);
  EXPECT_EQ(crash.exit_code, 1) << crash.out << crash.err;
  EXPECT_TRUE(says(crash.out, "DEFECT: exited with code 0; broken: total"));
  EXPECT_EQ(report()["outcome"], "defect");
  EXPECT_EQ(report()["detector_ended"], "exited with code 0; broken: total");
  const auto refusal = check("refuse", true);
  EXPECT_EQ(refusal.exit_code, 1) << refusal.out << refusal.err;
  EXPECT_NE(refusal.out.find("too many triangles"), std::string::npos) << refusal.out;
  const auto hang = check("hang", true, "--time 0.3");
  EXPECT_EQ(hang.exit_code, 3) << hang.out << hang.err;
  EXPECT_NE(hang.out.find("undecided: no answer in 0.3 s"), std::string::npos) << hang.out;
}

TEST_F(Plugin, AStepWithoutAnAnswerBreaksTotal) {
  const auto outcome = check("fail", true);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("step 1: evaluate returned 3"), std::string::npos) << outcome.out;
  EXPECT_EQ(report()["steps"][0]["diff"]["broken"], json::array({"total"}));
}

TEST_F(Plugin, CaseFilesAreRunByTheirScript) {
  const std::string cases = std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/";
  for (const std::string name : {"B1_one_vertex_own_nearest", "D8_release_arm_sequence"}) {
    const auto outcome =
        run_assay("check --detector " + plugin("wrapped_builtin") + " " + cases + name + ".json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }
}

TEST_F(Plugin, WhatCannotBeUsedIsRefusedInOneLine) {
  const std::string mesh = free;
  const auto expect_refused = [&](const std::string& arguments, const std::string& why) {
    const auto outcome = run_assay("check " + mesh + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect_refused("--detector /nowhere/lib.so", "/nowhere/lib.so: no such file");
  expect_refused("--detector " ASSAY_SOURCE_DIR "/README.md", "not a detector plug-in");
  const std::string pipe = scratch / "pipe.so";
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  expect_refused("--detector " + pipe, "not a detector plug-in: not a file");
  expect_refused("--detector " + plugin("without_entry"), "exports no assay_detector()");
  expect_refused("--detector " + plugin("wrong_abi"), "built for ABI version 99");
  expect_refused("--detector " + plugin("example") + " --culling bvh", "--culling");
}

}  // namespace
}  // namespace assay::tests
