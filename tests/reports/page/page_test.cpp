// The data of the page, assay-report/3, and the file into which the data is put.
#include "properties/campaign/gates/findings.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "reports/page/run_json.h"
#include "tests/reports/program.h"
#include "tests/reports/stored_run.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;

properties::RunFindings read_run(const std::string& folder) {
  return value_of(properties::read_findings(folder));
}

TEST(PageFile, DataCannotLeaveItsElement) {
  const Json data = {{"a", "</script><script>alert(1)</script><!--"},
                     {"b", "line\u2028and\u2029paragraph & more"},
                     {"c", std::string("\xff\xfe")}};
  const auto text = reports::script_safe(data);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
  for (const unsigned char c : text) EXPECT_LT(c, 0x80);
  const auto back = Json::parse(text);
  EXPECT_EQ(back["a"], data["a"]);
  EXPECT_EQ(back["b"], data["b"]);
}

TEST(PageFile, TheTemplateIsTheBuiltPageToTheByte) {
  EXPECT_EQ(reports::page_template(),
            read_text(std::string(ASSAY_SOURCE_DIR) + "/reports/page/dist/page.html"));
}

TEST(PageFile, DataStandsWhereTheTemplateHasItsMark) {
  const Json data = {{"schema", "assay-report/3"}, {"runs", Json::array()}};
  const auto page = reports::page_text(reports::page_template(), data);
  const std::string open = R"(<script id="assay-report" type="application/json">)";
  const auto begin = page.find(open) + open.size();
  EXPECT_EQ(Json::parse(page.substr(begin, page.find("</script>", begin) - begin)), data);
  EXPECT_THROW(reports::page_text("no mark", data), std::logic_error);
  EXPECT_THROW(reports::page_text("ASSAY_REPORT_DATA ASSAY_REPORT_DATA", data), std::logic_error);
}

class Runs : public testing::Test {
 protected:
  void expect_refused(const std::string& folder, const std::string& word) {
    const auto findings = properties::read_findings(folder);
    EXPECT_TRUE(says(findings, word));
    EXPECT_FALSE(says(findings, "\n"));
  }
  static RunToStore of_plugin(const std::string& library) {
    RunToStore run;
    run.request.plugin = library;
    run.request.detector.built_in = false;
    return run;
  }
  Json page_of(const RunToStore& run, const std::string& name) {
    return page_of(read_run(run.store(scratch / name)));
  }
  static Json page_of(const properties::RunFindings& findings) {
    return reports::run_json(findings, judge(findings));
  }
  // A failure that a plug-in of tests/plugins has under these words in its environment, as a scene.
  Json scene_of(const std::string& library, const char* variable, const char* words,
                const corpus::Case& c, const std::string& signature) {
    setenv(variable, words, 1);
    const auto run = of_plugin(plugin(library)).fail(c, signature, "a line");
    const auto scene = reports::failure_scenes(read_run(run.store(scratch / library)))[0]["scene"];
    unsetenv(variable);
    return scene;
  }
  const Scratch scratch;
};

TEST_F(Runs, WhatIsNoRunIsRefusedByName) {
  expect_refused(scratch / "nowhere", "nowhere: No such file");
  std::filesystem::create_directory(scratch / "empty");
  expect_refused(scratch / "empty", "no run is stored here");
  std::filesystem::create_directory(scratch / "text");
  scratch.write("text/run.sqlite", "this is no store");
  expect_refused(scratch / "text", "run.sqlite: file is not a database");
}

TEST_F(Runs, OfDifferentPlansAreRefused) {
  RunToStore run;
  run.store(scratch / "mixed");
  run.request.seed = 7;
  run.request.plan.strata[0].cases = 11;
  run.store(scratch / "mixed", "seed-7");
  expect_refused(scratch / "mixed",
                 "runs that cannot be judged together: campaign/strata/0/cases 10 and 11");
}

TEST_F(Runs, ASeedThatIsThereTwiceIsRefused) {
  RunToStore run;
  run.request.shares = 2;
  run.judge("closed-generic", 4, 'H').store(scratch / "twice");
  std::filesystem::copy_file(scratch / "twice/run.sqlite", scratch / "twice/seed-2.sqlite");
  expect_refused(scratch / "twice", "seed-2.sqlite: another store has the same seed, 1");
}

TEST_F(Runs, SharesAreSummed) {
  RunToStore run;
  run.request.shares = 2;
  const auto alone = run.judge("closed-generic", 4, 'H').store(scratch / "one");
  EXPECT_EQ(read_run(alone).quota(), 10u);
  EXPECT_FALSE(read_run(alone).is_whole());
  run.store(scratch / "two");
  RunToStore other;
  other.request.shares = 2;
  other.request.seed = 2;
  other.judge("closed-generic", 5, 'H').judge("broken", 1, 'D').store(scratch / "two", "seed-2");
  const auto findings = read_run(scratch / "two");
  EXPECT_EQ(findings.tally.trials(), 10u);
  EXPECT_EQ(findings.quota(), 20u);
  EXPECT_TRUE(findings.is_whole());
  const auto page = page_of(findings);
  EXPECT_EQ(page["findings"]["strata"][1]["with_defect"], 1u);
  const auto& parts = page["findings"]["campaign"]["parts"];
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1]["share"], "1/2");
  EXPECT_EQ(parts[0]["rows"], read_run(alone).rows);
}

// Which gate says what is gates_test's; here is that the page says it.
TEST_F(Runs, VerdictAndReasonsAreThoseOfTheGates) {
  const auto part = page_of(RunToStore().meet_canary(3).judge("closed-generic", 3, 'H'), "part");
  EXPECT_EQ(part["verdict"], "incomplete");
  EXPECT_EQ(part["why"], "gate \"complete\" fails: closed-generic: 3 of 10 trials; 2 more reasons");
  const auto wrong = page_of(RunToStore().meet_canary(3).judge("closed-generic", 3, 'D'), "wrong");
  EXPECT_EQ(wrong["verdict"], "defect") << "a defect stands, however little was judged";
  const auto whole = page_of(
      RunToStore().meet_canary(3).judge("closed-generic", 10, 'H').judge("broken", 10, 'H'), "all");
  EXPECT_EQ(whole["verdict"], "holds");
  EXPECT_EQ(whole["why"], "no gate fails");
  ASSERT_EQ(whole["findings"]["gates"].size(), 6u);
  EXPECT_EQ(whole["findings"]["gates"][1]["state"], "not judged")
      << "a run says nothing of the corpus";
}

TEST_F(Runs, ACertificateThatDoesNotVerifyIsNotBelieved) {
  const auto findings = read_run(RunToStore().store(scratch / "run"));
  const auto page = reports::run_json(findings, judge(findings), nullptr, "a line");
  EXPECT_EQ(page["verdict"], "unverified");
  EXPECT_EQ(page["why"], "the certificate does not verify: a line");
  EXPECT_TRUE(page["subject"].is_null());
}

TEST_F(Runs, DisturbedTrialsAndThoseNearTheirLimitAreCounted) {
  auto run = RunToStore().judge("closed-generic", 4, 'H').judge("broken", 1, 'U');
  run.trials[0].disturbed = 2;
  run.trials[1].slowest_us = 3'400'000;  // of 10 s
  run.trials[2].slowest_us = 3'300'000;
  run.trials[4].slowest_us = 9'000'000;  // in one configuration, and no answer in another
  const auto times = page_of(run, "disturbed")["findings"]["times"];
  EXPECT_EQ(times["strata"][1]["disturbed"], 1);
  EXPECT_EQ(times["near_the_limit"], 2);
}

TEST_F(Runs, APlugInsLibraryIsReadBack) {
  const auto findings = read_run(of_plugin("some/where.so").store(scratch / "plugin"));
  // Absolute: lines that name it are pasted anywhere.
  EXPECT_EQ(findings.library, std::filesystem::absolute("some/where.so").string());
  EXPECT_FALSE(findings.run.detector.built_in);
  EXPECT_EQ(findings.run.detector.configurations.size(), 12u);
}

TEST_F(Runs, APageTellsNoFolderOfTheMachineThatItIsMadeOn) {
  const std::string outside = "/somewhere/else/a detector.so";
  for (const auto& library : {outside, (scratch / "beside/own.so")}) {
    auto run = of_plugin(library).judge("broken", 1, 'D');
    run.fail("B1_one_vertex_own_nearest", "free-sound: answered free", "a line")
        .fail("A1_winding2_allpositive", "free-sound: answered free", "another");
    const std::string name = library == outside ? "one" : "other";
    const auto findings = read_run(run.store(scratch / name));
    auto page = page_of(findings);
    page["failures"] = reports::failure_scenes(findings);
    const std::string told = library == outside ? "a detector.so" : "../beside/own.so";
    const std::string word = library == outside ? "'a detector.so'" : told;
    EXPECT_EQ(page["folder"], name);
    EXPECT_EQ(page["library"], told);
    const auto end = "-smallest.json --detector " + word;
    for (const auto& line : {page["findings"]["failures"][0]["replay"].get<std::string>(),
                             page["failures"][0]["others"][0]["replay"].get<std::string>()}) {
      EXPECT_TRUE(line.starts_with("assay replay failures/")) << line;
      EXPECT_TRUE(line.ends_with(end)) << line;
    }
    EXPECT_FALSE(says(page.dump(), scratch / ""));
  }
}

// As when the shipped detector is broken. tests/page/run names a folder and looks at the page.
TEST_F(Runs, AFailingBuiltInDetectorIsShownWithItsViews) {
  const char* named = std::getenv("ASSAY_FAULTY_RUN");
  const std::string folder = named ? named : scratch / "faulty";
  RunToStore run;
  run.begun = "2026-01-31T12:00:00Z";
  run.meet_canary(3)
      .judge("broken", 3, 'D')
      .judge("closed-generic", 10, 'H')
      .fail("F_ghosts_move", "free-sound: answered free, vertex-face, t inside",
            "triangles 0 and 3 meet; answered free")
      .fail("A1_winding2_allpositive", "all-pairs: missing pair, edge-edge, t inside, moving",
            "triangles 1 and 2 meet; not reported");
  const auto scenes = reports::failure_scenes(read_run(run.store(folder)));
  ASSERT_EQ(scenes.size(), 2u);
  for (const auto& shown : scenes) EXPECT_TRUE(shown["scene"].is_object()) << shown["not_shown"];
  const bool has_ghosts = std::any_of(scenes.begin(), scenes.end(), [](const Json& shown) {
    return !shown.at("scene").at("steps").at(0).at("views").at("ghosts").empty();
  });
  EXPECT_TRUE(has_ghosts);
}

// Shares begin one after another. What began before that was stored says nothing.
TEST_F(Runs, TheDayOnWhichTheFirstShareBeganIsTold) {
  RunToStore run;
  run.request.plan.strata = {{"closed-generic", 10, 0}};
  const std::string folder = scratch / "shares";
  run.request.shares = 2;
  for (const std::uint64_t seed : {1, 2}) {
    run.request.seed = seed;
    run.begun = seed == 1 ? "2026-02-01T00:10:00Z" : "2026-01-31T23:50:00Z";
    run.store(folder, "seed-" + std::to_string(seed));
  }
  EXPECT_EQ(page_of(read_run(folder))["begun"], "2026-01-31T23:50:00Z");
  EXPECT_TRUE(page_of(RunToStore(), "older")["begun"].is_null());
}

// A run stores the digest of its program alone.
TEST_F(Runs, TheVersionIsKnownWhereTheSameProgramMakesThePage) {
  auto findings = read_run(RunToStore().store(scratch / "run"));
  EXPECT_TRUE(page_of(findings)["findings"]["versions"]["assay"].is_string());
  findings.run.digests.program->front() ^= 1;
  EXPECT_TRUE(page_of(findings)["findings"]["versions"].is_null());
}

TEST_F(Runs, WhatALawSaysStandsBesideIt) {
  RunToStore run;
  run.judge("closed-generic", 2, 'H');
  run.trials[0].counts.laws["L4_AllPositiveIsCollisionFree_Line"].premise = 3;
  run.trials[1].counts.laws["L4_OfAnotherBuild"].premise = 1;
  const auto page = page_of(run, "laws");
  EXPECT_FALSE(page["law_statements"].contains("L4_OfAnotherBuild"));
  EXPECT_EQ(page["law_statements"]["L4_AllPositiveIsCollisionFree_Line"],
            properties::law_named("L4_AllPositiveIsCollisionFree_Line")->statement);
}

TEST_F(Runs, WhatAPlugInPrintedStandsWithItsFailure) {
  auto run = of_plugin("some/where.so").judge("broken", 1, 'D');
  run.fail("B1_one_vertex_own_nearest", "free-sound: answered free", "a line");
  const auto silent = read_run(run.store(scratch / "silent"));
  EXPECT_TRUE(reports::failure_scenes(silent)[0]["printed"].is_null());
  run.failures[0].printed = "first\n</script> second";
  const auto told = read_run(run.store(scratch / "told"));
  EXPECT_EQ(reports::failure_scenes(told)[0]["printed"], "first\n</script> second");
  EXPECT_EQ(told.rows, silent.rows) << "two runs may differ in it";
}

TEST_F(Runs, BoundsAreThoseOfTheTerminal) {
  const auto json = page_of(
      RunToStore().judge("closed-generic", 10, 'H').judge("broken", 9, 'H').judge("broken", 1, 'D'),
      "bounds");
  const auto& findings = json["findings"];
  ASSERT_EQ(findings["strata"].size(), 2u);
  const auto& row = findings["strata"][0]["bounds"][0];
  EXPECT_EQ(row["n"], 10);
  std::size_t claims = 0;
  const auto detector = properties::built_in_detector();
  for (const auto& configuration : detector.configurations)
    claims += properties::list_of(detector.claims_in(configuration)).size();
  EXPECT_EQ(findings["confidence"]["bounds"], 2 * claims);
  // None of ten fails: (1 - p)^10 is the risk of one of them.
  EXPECT_NEAR(std::pow(1 - row["bound"].get<double>(), 10), 0.05 / (2.0 * claims), 1e-12);
  EXPECT_GT(findings["strata"][1]["bounds"][0]["bound"], row["bound"]);
}

TEST_F(Runs, AreOfTheSchema) {
  RunToStore run;
  run.judge("closed-generic", 2, 'H').judge("broken", 2, 'D');
  run.trials[0].counts.laws["L4_X"].premise = 3;
  run.fail("D8_release_arm_sequence", "all-pairs: missing", "one")
      .fail("B1_one_vertex_own_nearest", "all-pairs: missing", "two");
  run.meet_canary(4);
  const auto findings = read_run(run.store(scratch / "fields"));
  auto json = page_of(findings);
  json["failures"] = reports::failure_scenes(findings);
  ASSERT_EQ(json["failures"].size(), 1u) << "one a signature";
  EXPECT_EQ(json["findings"]["failures"].size(), 1u);
  EXPECT_EQ(json["failures"][0]["others"].size(), 1u);
  expect_schema("report", {{"schema", "assay-report/3"}, {"version", ""}, {"runs", {json}}});
}

TEST_F(Runs, ASceneHoldsWhatTheOracleFound) {
  const auto c = curated_case("A1_winding2_allpositive");
  const auto run = RunToStore().fail(c.id, "all-pairs: missing", c.about);
  const auto scene = reports::failure_scenes(read_run(run.store(scratch / "scene")))[0]["scene"];
  const auto& pairs = scene["steps"][0]["oracle"]["pairs"];
  const auto& expected = *c.expected.steps[0].pairs;
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(pairs[i]["triangles"][0], expected[i].pair.a);
    EXPECT_EQ(pairs[i]["triangles"][1], expected[i].pair.b);
    EXPECT_EQ(pairs[i]["time"][0].get<double>(), expected[i].time.lo);
    EXPECT_EQ(pairs[i]["time"][1].get<double>(), expected[i].time.hi);
    EXPECT_EQ(pairs[i]["places"].size(), 2u);
    EXPECT_EQ(pairs[i]["places"][0].size(), 3u);
  }
  EXPECT_EQ(scene["steps"][0]["detector"]["pairs"], pairs) << "the built-in detector is right";
  EXPECT_EQ(scene["steps"][0]["views"]["sets"].size(), 12u);
  EXPECT_EQ(scene["steps"][0]["views"]["primitives"][0]["q1"], nullptr) << "a view-point";
  EXPECT_TRUE(scene["asked"].is_null());
  EXPECT_TRUE(scene["bodies"].is_null());
  EXPECT_EQ(scene["triangles"].size(), 12u);
  EXPECT_EQ(scene["frames"].size(), 2u);
}

// A page that holds a neighbour against a detector that tests none accuses it of what nobody
// promised.
TEST_F(Runs, ASceneObeysThePlugInsContract) {
  const auto scene = scene_of("by_contract", "ASSAY_BY_CONTRACT", "strangers drop-last",
                              curated_case("A1_winding2_allpositive"), "all-pairs: missing pair");
  const auto& step = scene["steps"][0];
  ASSERT_FALSE(step["left_out"].empty());
  EXPECT_EQ(step["oracle"]["pairs"].size() + step["left_out"].size(), 10u);
  std::map<std::string, std::size_t> counts;
  for (const auto& one : step["differences"]) ++counts[one["difference"]];
  EXPECT_EQ(counts["missing"], 1u);
  EXPECT_EQ(counts["left out by the contract"], step["left_out"].size());
  EXPECT_TRUE(step["views"].is_null()) << "of a plug-in nobody knows them";
}

TEST_F(Runs, ASceneUnderADistanceHasTheNearestPointsAndTheBodies) {
  const auto scene = scene_of("keeps_distance", "ASSAY_KEEPS_DISTANCE", "separation=0.5 ignores-it",
                              one_above_another(1, 0), "not-late: late");
  EXPECT_EQ(scene["asked"], "d 0.5");
  EXPECT_EQ(scene["bodies"], Json::array({0, 1}));
  const auto& step = scene["steps"][0];
  const auto& exact = step["oracle"]["pairs"][0];
  EXPECT_EQ(exact["distance"], 0.5);
  EXPECT_EQ(exact["places"], Json::parse("[[1.0, 1.0, 0.0], [1.0, 1.0, 0.5]]"));
  const auto& late = step["detector"]["pairs"][0];
  EXPECT_EQ(late["time"][0], 1.0);
  EXPECT_EQ(late["distance"], 0.0);
  EXPECT_EQ(late["places"], Json::parse("[[1.0, 1.0, 0.0], [1.0, 1.0, 0.0]]"));
}

}  // namespace
}  // namespace assay::tests
