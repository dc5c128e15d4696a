// Reports to the owner of a detector: error rates about which it makes no claim, claims that no
// case has tested, and the cases on which it takes longest.
#include <sys/stat.h>

#include "properties/campaign/gates/findings.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;

class ForeignDetector : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out", library = plugin("by_contract");

  // tests/plugins/by_contract.cpp says what the words are.
  Outcome judge(const std::string& verb, const std::string& words, const std::string& plan,
                const std::string& more = "") const {
    return run_assay(verb + " --campaign " + scratch.write("plan.json", plan) + " --out " + out +
                         " --detector " + library + " " + more,
                     "ASSAY_BY_CONTRACT=\"" + words + "\" ");
  }
};

// Claims free-sound, not-late and total.
constexpr const char* modest = "claims=131 ";

TEST_F(ForeignDetector, TheRateOfItsAlarmsIsToldWhateverItClaims) {
  const auto made =
      expect_ended(judge("certify", std::string(modest) + "alarm-share=0.1", plan_text(120)), 0);
  std::uint64_t alarms = 0, free_steps = 0;
  const Json stated = predicate_in(out);
  for (const auto& stratum : stated["strata"]) {
    const auto& rate = stratum["measures"]["false_alarms"];
    EXPECT_LE(rate["interval"][0].get<double>(), 0.1) << rate;
    EXPECT_GE(rate["interval"][1].get<double>(), 0.1) << rate;
    alarms += rate["of"].get<std::uint64_t>();
    free_steps += rate["in"].get<std::uint64_t>();
    EXPECT_TRUE(says(made.out, std::to_string(rate["of"].get<int>()) + " of " +
                                   std::to_string(rate["in"].get<int>()) + ", "));
  }
  EXPECT_GT(free_steps, 100u);
  EXPECT_GT(alarms, 0u);
  const auto page = out + "/page.html";
  ASSERT_EQ(run_assay("report " + out + " --out " + page).exit_code, 0);
  const auto text = read_text(page);
  const auto first = stated["strata"][0]["measures"]["false_alarms"]["of"].get<int>();
  EXPECT_TRUE(contains(text, "\"false_alarms\":{\"of\":" + std::to_string(first)));
}

// Below each heading there is a row, and nowhere are two lines empty.
void expect_no_empty_table(const std::string& text) {
  EXPECT_FALSE(contains(text, "\n\n\n")) << text;
  for (const std::string head :
       {"stratum ", "law ", "fault ", "input ", "whatever is claimed", "gate ", "speed ("}) {
    for (auto at = text.find("\n" + head); at != std::string::npos;
         at = text.find("\n" + head, at + 1)) {
      EXPECT_NE(text[text.find('\n', at + 1) + 1], '\n') << head << "\n" << text;
    }
  }
}

TEST_F(ForeignDetector, WhoClaimsLittleSeesNoEmptyTable) {
  for (const std::string words : {"claims=128 no-pairs", "claims=1 no-pairs start=free"}) {
    std::filesystem::remove_all(out);
    expect_no_empty_table(expect_ended(judge("run", words, plan_text(6)), 0).out);
    const auto checked = run_assay("check " + curated("D6_fast_passage") + " --detector " + library,
                                   "ASSAY_BY_CONTRACT='" + words + "' ");
    expect_no_empty_table(checked.out);
    EXPECT_FALSE(contains(checked.out, "sets:")) << "of the built-in's stages";
    EXPECT_FALSE(contains(read_text(out + "/junit.xml"), "tests=\"0\""));
    for (const std::string list : {"slow", "failures"})
      expect_no_empty_table(run_assay("list " + list + " " + out).out);
  }
  const auto made =
      expect_ended("certify --campaign " + scratch.write("plan.json", plan_text(6)) + " --out " +
                       (scratch / "certified") + " --detector " + plugin("misses_on_97"),
                   0);
  expect_no_empty_table(made.out);
  EXPECT_FALSE(contains(read_text(scratch / "certified/junit.xml"), "tests=\"0\""));
  EXPECT_TRUE(predicate_in(scratch / "certified")["laws"].is_null());
  EXPECT_TRUE(predicate_in(scratch / "certified")["cases"]["set_pairs"].empty());
}

TEST_F(ForeignDetector, WhatItPrintsStandsWithItsFailuresAndNowhereElse) {
  const auto ran = expect_ended(
      judge("run", std::string(modest) + "miss-inside print=2", plan_text(8), "--jobs 1"), 1);
  EXPECT_FALSE(contains(ran.err, "line 1 of")) << ran.err;
  const auto said = ran.out.find("  it printed:\n    line 1 of ?[31m");
  ASSERT_NE(said, std::string::npos) << ran.out;
  EXPECT_LT(ran.out.find("DEFECT free-sound: answered free"), said);
  EXPECT_FALSE(contains(ran.out, "\x1b")) << "escape characters do no harm";
  const auto failures = properties::read_findings(out).value().failures;
  ASSERT_FALSE(failures.empty());
  for (const auto& failure : failures)
    EXPECT_TRUE(contains(failure.printed, "line 2 of ?[31m")) << failure.id();
  EXPECT_TRUE(contains(run_assay("list failures " + out).out, "  it printed:\n"));
  expect_ended(run_assay(replay_lines(ran.out).front(),
                         "ASSAY_BY_CONTRACT='claims=131 miss-inside print=2' "),
               1, {"  it printed:\n    line 1 of ?[31m"});
}

TEST_F(ForeignDetector, ItsStoredFailuresAccuseNobodyElse) {
  ASSERT_EQ(judge("run", std::string(modest) + "miss-inside", plan_text(4)).exit_code, 1);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out + "/failures")) {
    if (entry.path().extension() != ".json") continue;
    expect_ended("check " + entry.path().string(), 0);
    ++files;
  }
  EXPECT_GE(files, 2u);
}

TEST_F(ForeignDetector, CheckTellsTheExactTimeBesideItsOwn) {
  const auto check = [&](const std::string& words) {
    return run_assay("check " + curated("D6_fast_passage") + " --detector " + library + " --json " +
                         (scratch / "check.json"),
                     "ASSAY_BY_CONTRACT='claims=1 " + words + "' ")
        .out;
  };
  const auto wide = check("whenever");
  const auto step = read_json(scratch / "check.json")["steps"][0];
  const auto exact = step["oracle"]["first_time"][0].get<double>();
  EXPECT_GT(exact, 0);
  EXPECT_EQ(step["diff"]["first"]["early_by"].get<double>(), exact) << "by the lower end";
  expect_says(wide, {"  first time [0, 1], exact ", ": early by ", "early in 1 step, by "});
  const auto right = check("");
  EXPECT_TRUE(contains(right, "  first time 0.") && contains(right, ", exact 0.")) << right;
  EXPECT_FALSE(contains(right, "early") || contains(right, "late")) << right;
  EXPECT_TRUE(contains(check("late=0.125"), ": late by 0.125\n"));
  EXPECT_TRUE(contains(check("miss-inside"), "  exact first time 0."));
}

// What is in contact by the oracle is told as the contract has it, with what it leaves out.
TEST_F(ForeignDetector, CheckObeysTheContract) {
  const auto checked =
      expect_ended(run_assay("check " + curated("A1_winding2_allpositive") + " --detector " +
                                 library + " --json " + (scratch / "check.json"),
                             "ASSAY_BY_CONTRACT=strangers "),
                   0);
  const auto step = read_json(scratch / "check.json")["steps"][0];
  const auto left_out = step["diff"]["left_out"].get<int>();
  EXPECT_GT(left_out, 0);
  EXPECT_EQ(step["oracle"]["pairs"].get<int>() + left_out, 10);
  EXPECT_TRUE(says(checked.out, std::to_string(left_out) + " pairs left out by the contract"));
}

TEST_F(ForeignDetector, NoCertificateNamesWhatNobodyJudged) {
  // It always answers collision at [0, 1], under the widest contract that loads.
  const auto made = expect_ended(
      judge("certify", "claims=255 whenever no-pairs margin=1e300 tolerance=1e-3 start=free",
            plan_text(12)),
      0);
  std::vector<std::string> not_judged;
  const Json stated = predicate_in(out);
  for (const auto& one : stated["not_judged"])
    not_judged.push_back(one["claim"].get<std::string>());
  EXPECT_EQ(not_judged,
            (std::vector<std::string>{"first-time", "first-pairs", "all-pairs", "no-spurious"}));
  const auto verdict = made.out.substr(made.out.rfind("\nverdict: "));
  const auto judged = verdict.substr(0, verdict.find("; not judged: "));
  for (const char* claim : {"first-time", "first-pairs", "all-pairs", "no-spurious"}) {
    EXPECT_FALSE(contains(judged, claim)) << verdict;
    EXPECT_TRUE(contains(verdict, claim)) << verdict;
  }
}

TEST_F(ForeignDetector, NoContractSavesOneThatAlwaysAnswersFree) {
  // The mesh is scaled, so that the contract takes it; and where a range of coordinates forbids
  // that, nothing is left to be judged.
  const std::string free = " miss-at-start miss-inside adjacency=2 start=apart:1e4";
  for (const std::string& words : {free, free + " claims=1", free + " claims=129 no-pairs"}) {
    std::filesystem::remove_all(out);
    SCOPED_TRACE(words);
    expect_ended(judge("run", words, plan_text(12)), 1, {"\nDEFECT: "});
  }
  std::filesystem::remove_all(out);
  expect_ended(judge("run", free + " range=1e-6:1", plan_text(12)), 3,
               {"\nincomplete: ", "closed-generic: 0 of 12 planned cases have a contact inside"});
  // An honest one under a narrow contract holds.
  std::filesystem::remove_all(out);
  expect_ended(
      judge("run", "start=apart:0.05 adjacency=2 features=vertex-face float32", plan_text(12)), 0);
}

TEST_F(ForeignDetector, ItsSlowCasesAreListed) {
  const std::string plan =
      R"({"schema": "assay-campaign/1", "name": "tiny", "seconds": 20, "shrink_share": 0.2,)"
      R"( "strata": [{"family": "closed-degenerate", "cases": 12}]})";
  expect_ended(
      judge("run", "claims=131 start=free no-pairs burn=30", plan, "--case-seconds 0.1 --jobs 2"),
      3, {"/assay list slow "});
  const auto listed = expect_ended("list slow " + out, 0, {" without a verdict, at most 0.1 s"});
  EXPECT_FALSE(replay_lines(listed.out).empty());
}

TEST_F(ForeignDetector, AContractThatTakesNoCaseIsIncomplete) {
  expect_ended(judge("run", std::string(modest) + "start=apart:1e300", plan_text(4)), 3,
               {"0 of 3 families have a contact inside the contract, 3 are wanted"});
}

TEST_F(ForeignDetector, WhatClaimsNothingThatIsLeftIsRefused) {
  const auto made = judge("run", "claims=32 margin=1", plan_text(4));
  expect_refused(made, "under its contract no claim can be judged");
  expect_refused(run_assay("check " + curated("A4_endpoints_only") + " --detector " + library,
                           "ASSAY_BY_CONTRACT=\"claims=32 margin=1\" "),
                 "under its contract no claim can be judged");
}

// `assay check --detector`: a plug-in through the command line, as its owner runs it.
class Plugin : public testing::Test {
 protected:
  // On a scene that collides or one that does not, with a report.
  static Outcome check(const std::string& name, bool collides, const std::string& more = "") {
    return run_assay("check --detector " + plugin(name) + " --json " + (scratch / "report.json") +
                     " " + (collides ? colliding : free) + " " + more);
  }
  static Json report() { return read_json(scratch / "report.json"); }

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
  EXPECT_EQ(report()["steps"][0]["first_time"], Json::array({0, 1}));
}

TEST_F(Plugin, ABrokenClaimIsNamed) {
  expect_ended(check("always_free", true), 1, {"broken: free-sound first-pairs all-pairs"});
  const auto steps = report()["steps"];
  EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [](const Json& step) {
    return step["diff"]["broken"] == Json::array({"free-sound", "first-pairs", "all-pairs"});
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
  EXPECT_EQ(report()["steps"][0]["diff"]["broken"], Json::array({"total"}));
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
