// The data of the page, assay-report/1, and the file that it is put into.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "properties/faults/fault.h"
#include "reports/page_data/failure_scenes.h"
#include "reports/page_data/page_file.h"
#include "reports/page_data/run_json.h"
#include "reports/page_data/run_verdict_text.h"
#include "tests/reports/program.h"
#include "tests/reports/stored_run.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;
using reports::read_run;

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
  const Json data = {{"schema", "assay-report/1"}, {"runs", Json::array()}};
  const auto page = reports::page_text(reports::page_template(), data);
  const std::string open = R"(<script id="assay-report" type="application/json">)";
  const auto begin = page.find(open) + open.size();
  const auto end = page.find("</script>", begin);
  EXPECT_EQ(Json::parse(page.substr(begin, end - begin)), data);
  EXPECT_THROW(reports::page_text("no mark", data), std::logic_error);
  EXPECT_THROW(reports::page_text("ASSAY_REPORT_DATA ASSAY_REPORT_DATA", data), std::logic_error);
}

class Runs : public testing::Test {
 protected:
  void expect_refused(const std::string& folder, const std::string& word) {
    const auto run = read_run(folder);
    ASSERT_FALSE(run) << folder;
    EXPECT_NE(run.error().message.find(word), std::string::npos) << run.error().message;
    EXPECT_EQ(run.error().message.find('\n'), std::string::npos) << run.error().message;
  }
  reports::RunVerdictText verdict_in(const RunToStore& run, const std::string& name) {
    const auto read = read_run(run.store(scratch / name));
    EXPECT_TRUE(read);
    return reports::verdict_of(read.value());
  }
  const Scratch scratch;
};

TEST_F(Runs, WhatIsNoRunIsRefusedByName) {
  expect_refused(scratch / "nowhere", "nowhere");
  std::filesystem::create_directory(scratch / "empty");
  expect_refused(scratch / "empty", "no run is stored here");
  std::filesystem::create_directory(scratch / "text");
  scratch.write("text/shard-1-of-1.sqlite", "this is no store");
  expect_refused(scratch / "text", "shard-1-of-1.sqlite");
}

TEST_F(Runs, ShardsOfDifferentRunsAreRefused) {
  RunToStore run;
  run.request.shard = {1, 2};
  run.store(scratch / "mixed");
  run.request.shard = {2, 2};
  run.request.seed = 7;
  run.store(scratch / "mixed");
  expect_refused(scratch / "mixed", "different runs");
}

TEST_F(Runs, ShardsAreSummed) {
  RunToStore run;
  run.request.shard = {1, 2};
  run.judge("closed-generic", 4, 'H').store(scratch / "two");
  RunToStore other;
  other.request.shard = {2, 2};
  other.judge("closed-generic", 5, 'H').judge("broken", 1, 'D').store(scratch / "two");
  const auto read = read_run(scratch / "two");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().trials(), 10u);
  EXPECT_EQ(read.value().planned_trials(), 20u);
  EXPECT_EQ(reports::defect_trials(read.value()), 1u);
}

TEST_F(Runs, TheVerdictIsTheFirstGateThatFails) {
  EXPECT_EQ(verdict_in(RunToStore().judge("closed-generic", 3, 'H'), "part").word, "incomplete");
  EXPECT_EQ(verdict_in(RunToStore().judge("closed-generic", 3, 'D'), "wrong").word, "defect")
      << "a defect stands, however little was judged";
  const auto whole =
      verdict_in(RunToStore().judge("closed-generic", 10, 'H').judge("broken", 10, 'H'), "whole");
  EXPECT_EQ(whole.word, "holds");
  EXPECT_FALSE(whole.certified);
  EXPECT_EQ(whole.gates.size(), 6u);
}

TEST_F(Runs, TheHarnessGoesBeforeAllElse) {
  const auto whole = [] {
    return RunToStore().judge("closed-generic", 10, 'D').judge("broken", 10, 'H');
  };
  EXPECT_EQ(verdict_in(whole().meet_canary(4), "seen").word, "defect");
  EXPECT_EQ(verdict_in(whole().meet_canary(std::nullopt), "blind").word, "unsound-harness");
  const auto with_fault = [&](const std::string& curated) {
    auto run = whole().meet_canary(4);
    run.evidence.push_back({"fault", "x/y", "1/1", 2,
                            R"({"law": "L3", "status": "planted", "curated": )" + curated +
                                R"(, "needed": [null], "cases": 9, "time_over": false,
                                "known_vertices": 0, "shrunk": null})"});
    return run;
  };
  EXPECT_EQ(verdict_in(with_fault("false"), "survives").word, "unsound-harness");
  EXPECT_EQ(verdict_in(with_fault("true"), "curated").word, "defect")
      << "its curated case shows it, if no random one does";
}

TEST_F(Runs, WhatIsLeftOpenWhereNoBoundIsWantedIsUndecided) {
  const auto verdict =
      verdict_in(RunToStore().judge("closed-generic", 10, 'H').judge("broken", 10, 'U'), "open");
  EXPECT_EQ(verdict.word, "undecided");
  EXPECT_NE(verdict.why.find("broken"), std::string::npos) << verdict.why;
}

TEST_F(Runs, APlugInsLibraryIsReadBack) {
  RunToStore run;
  run.request.plugin = "some/where.so";
  run.request.detector.built_in = false;
  const auto read = read_run(run.store(scratch / "plugin"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().detector.library, "some/where.so");
  EXPECT_FALSE(read.value().detector.built_in);
  EXPECT_EQ(read.value().detector.configurations.size(), 9u);
}

TEST_F(Runs, BoundsAreThoseOfTheTerminal) {
  const auto folder = RunToStore()
                          .judge("closed-generic", 10, 'H')
                          .judge("broken", 9, 'H')
                          .judge("broken", 1, 'D')
                          .store(scratch / "bounds");
  const auto json = reports::run_json(read_run(folder).value());
  ASSERT_EQ(json["strata"].size(), 2u) << "nine configurations that agree are one row";
  const auto& row = json["strata"][0];
  EXPECT_EQ(row["n"], 10);
  std::size_t claims = 0;
  const auto detector = properties::built_in_detector();
  for (const auto& configuration : detector.configurations)
    claims += properties::list_of(detector.claims_in(configuration)).size();
  EXPECT_EQ(json["bounds"]["together"], 2 * claims);
  // None of ten fails: (1 - p)^10 is the risk of one of them.
  EXPECT_NEAR(std::pow(1 - row["bound"].get<double>(), 10), 0.05 / (2.0 * claims), 1e-12);
  EXPECT_GT(json["strata"][1]["bound"], row["bound"]);
}

// Every field of assay-report/1, `runs[].strata[].n` as "n".
void names_of(const Json& json, std::set<std::string>& names) {
  // These have names of the data as keys.
  const std::set<std::string> free_keys = {"tags", "signatures"};
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      names.insert(key);
      if (!free_keys.count(key)) names_of(value, names);
    }
  } else if (json.is_array()) {
    for (const auto& value : json) names_of(value, names);
  }
}

TEST_F(Runs, EveryFieldIsDocumented) {
  RunToStore run;
  run.judge("closed-generic", 2, 'H').judge("broken", 2, 'D');
  run.trials[0].counts["law:L4_X/premise"] = 3;
  run.fail("D8_release_arm_sequence", "all-pairs: missing", "one")
      .fail("B1_one_vertex_own_nearest", "all-pairs: missing", "two");
  run.meet_canary(4);
  run.evidence.push_back(
      {"fault", std::string(properties::faults()[0].name), "1/1", 2,
       R"({"law": "L3", "status": "planted", "curated": true, "needed": [5, null], "cases": 9,
           "time_over": true, "known_vertices": 5, "shrunk": {"before": {"triangles": 9,
           "vertices": 7, "steps": 2}, "after": {"triangles": 4, "vertices": 5, "steps": 1},
           "calls": 12}})"});
  run.evidence.push_back({"world", "square-2", "1/1", 3,
                          R"({"classes": 3, "motions": 4, "all": 5, "collisions": 1,
                              "complete": true, "counterexample": null})"});
  const auto folder = run.store(scratch / "fields");
  const auto read = read_run(folder);
  ASSERT_TRUE(read);
  auto json = reports::run_json(read.value());
  json["failures"] = reports::failures_json(read.value());
  ASSERT_EQ(json["failures"].size(), 1u) << "one a signature";
  EXPECT_EQ(json["failures"][0]["others"].size(), 1u);
  std::set<std::string> names;
  names_of({{"schema", "assay-report/1"}, {"version", ""}, {"runs", {json}}}, names);
  EXPECT_GT(names.size(), 90u);
  const auto readme = read_text(std::string(ASSAY_SOURCE_DIR) + "/reports/README.md");
  const auto begin = readme.find("schema `assay-report/1`");
  ASSERT_NE(begin, std::string::npos);
  const auto documented = readme.substr(begin, readme.find("\n## ", begin) - begin);
  for (const auto& name : names)
    EXPECT_NE(documented.find("`" + name + "`"), std::string::npos) << name;
}

TEST_F(Runs, ASceneHoldsWhatTheOracleFound) {
  const auto c = curated_case("A1_winding2_allpositive");
  const auto folder =
      RunToStore().fail(c.id, "all-pairs: missing", c.about).store(scratch / "scene");
  const auto scene = reports::failures_json(read_run(folder).value())[0]["scene"];
  const auto& pairs = scene["steps"][0]["oracle"]["pairs"];
  const auto& expected = *c.expected.steps[0].pairs;
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(pairs[i]["triangles"][0], expected[i].pair.a);
    EXPECT_EQ(pairs[i]["triangles"][1], expected[i].pair.b);
    EXPECT_EQ(pairs[i]["time"][0].get<double>(), expected[i].time.lo);
    EXPECT_EQ(pairs[i]["time"][1].get<double>(), expected[i].time.hi);
    EXPECT_EQ(pairs[i]["point"].size(), 3u);
  }
  EXPECT_EQ(scene["steps"][0]["detector"]["pairs"], pairs) << "the built-in detector is right";
  EXPECT_EQ(scene["steps"][0]["views"]["sets"].size(), 12u);
  EXPECT_EQ(scene["steps"][0]["views"]["primitives"][0]["q1"], nullptr) << "a view-point";
  EXPECT_EQ(scene["triangles"].size(), 12u);
  EXPECT_EQ(scene["frames"].size(), 2u);
}

}  // namespace
}  // namespace assay::tests
