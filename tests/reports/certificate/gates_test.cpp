// Each gate fails for each of its reasons, and the first one that fails names the verdict.
#include "reports/certificate/gates.h"

#include <gtest/gtest.h>

#include "reports/certificate/junit.h"
#include "reports/certificate/summary.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// A predicate, all of whose gates hold.
Json good() {
  return Json::parse(R"({
    "detector": {"name": "built-in", "built_in": true},
    "campaign": {"name": "tiny", "seed": 1, "missing_shards": [], "planted_faults": 2, "plan": {
      "fault_cases": 100, "policy": {"power": 1, "self_test_queries": 10,
                                     "speed_limits": {"exact-over-double": 1.3}}}},
    "confidence": {"bounds": 8, "family": 0.95, "speaks_of": "cases"},
    "strata": [{"family": "broken", "planned": 20, "trials": 20, "distinct": 20, "discards": 0,
      "wanted_bound": 0.5, "bounds": [{"configuration": "bvh", "n": 20, "holds": 20, "defects": 0,
      "undecided": 0, "errors": 0, "bound": 0.2}]}],
    "laws": {"wanted_premises": 4, "laws": [{"law": "L3_X", "premises": 8, "close": 2,
                                             "broken": 0}]},
    "power": {"canaries": [{"fault": "c", "shard": "1/1", "found_after": 7}], "planted": 2,
      "found": 2, "faults": [
        {"fault": "a", "status": "planted", "found": true, "time_over": false, "cases": 100},
        {"fault": "b", "status": "planted", "found": true, "time_over": false, "cases": 100},
        {"fault": "e", "status": "equivalent", "found": false, "time_over": false, "cases": 100},
        {"fault": "o", "status": "open", "found": false, "time_over": false, "cases": 100}],
      "worlds": [{"world": "square-2", "counterexample": null}]},
    "harness_problems": [],
    "self_test": {"contradictions": 0, "complete": true},
    "corpus": [{"input": "curated cases", "configuration": "bvh", "failed": []}],
    "failures": [], "waivers": [],
    "times": {"speed": [{"what": "exact-over-double", "median": 1.2}]}})");
}

Json failure(const std::string& signature, int met, bool waived) {
  return {{"signature", signature}, {"configuration", "bvh"},    {"met", met},
          {"waived", waived},       {"what", "a & b < c"},       {"case", "tiny:1:broken:3"},
          {"after", nullptr},       {"replay", "assay replay x"}};
}

// What the predicate comes to after changes by JSON pointer.
Json verdict_after(const std::vector<std::pair<const char*, Json>>& changes, Json p = good()) {
  for (const auto& [place, value] : changes) p[Json::json_pointer(place)] = value;
  return verdict_of(gates_of(p));
}

void expect(const Json& verdict, const char* gate, const char* word, int code) {
  EXPECT_EQ(verdict["failed_gate"], gate);
  EXPECT_EQ(verdict["verdict"], word);
  EXPECT_EQ(verdict["exit_code"], code);
}

TEST(Gates, AllHoldOnAGoodRun) {
  const auto gates = gates_of(good());
  std::vector<std::string> names;
  for (const auto& gate : gates) {
    names.push_back(gate["gate"]);
    EXPECT_TRUE(gate["holds"]) << gate.dump();
  }
  EXPECT_EQ(names, (std::vector<std::string>{"harness", "complete", "corpus", "claims", "bounds",
                                             "speed"}));
  const auto verdict = verdict_of(gates);
  EXPECT_EQ(verdict["verdict"], "certified");
  EXPECT_EQ(verdict["exit_code"], 0);
  EXPECT_TRUE(verdict["failed_gate"].is_null());
}

TEST(Gates, AnUnsoundHarnessCertifiesNothing) {
  const std::vector<std::vector<std::pair<const char*, Json>>> unsound = {
      {{"/power/canaries/0/found_after", nullptr}},
      {{"/power/faults/1/found", false}},
      {{"/power/faults/2/found", true}},
      {{"/harness_problems", Json::array({"no worker"})}},
      {{"/self_test/contradictions", 1}},
      {{"/laws/laws/0/premises", 3}},
      {{"/laws/laws/0/close", 1}},
      {{"/strata/0/bounds/0/defects", 1}},  // without a failure that was stored
      {{"/failures", Json::array({failure("free-sound: missing", 1, false)})}}};
  for (const auto& changes : unsound) {
    SCOPED_TRACE(changes[0].first);
    expect(verdict_after(changes), "harness", "unsound-harness", 4);
  }
  // Half of the power is wanted, and there; laws are starved only when all trials took place.
  EXPECT_EQ(verdict_after({{"/power/faults/1/found", false},
                           {"/campaign/plan/policy/power", 0.5}})["verdict"],
            "certified");
  expect(verdict_after({{"/laws/laws/0/premises", 3}, {"/strata/0/trials", 19}}), "complete",
         "incomplete", 3);
}

TEST(Gates, WhatIsAbsentIsIncomplete) {
  const std::vector<std::pair<const char*, Json>> absent = {
      {"/strata/0/trials", 19},
      {"/campaign/missing_shards", Json::array({"2/2"})},
      {"/power/canaries", Json::array()},
      {"/power/planted", 1},
      {"/corpus", nullptr},
      {"/self_test", nullptr},
      {"/self_test/complete", false}};
  for (const auto& change : absent) {
    SCOPED_TRACE(change.first);
    expect(verdict_after({change}), "complete", "incomplete", 3);
  }
  // The time was over: no proof against the harness.
  expect(verdict_after({{"/power/faults/1/found", false}, {"/power/faults/1/time_over", true}}),
         "complete", "incomplete", 3);
}

TEST(Gates, CorpusAndWaivers) {
  const Json failed = {{"case", "A1"}, {"signature", "s"}, {"what", "w"}, {"waived", false}};
  expect(verdict_after({{"/corpus/0/failed", Json::array({failed})}}), "corpus", "defect", 1);
  Json waived = failed;
  waived["waived"] = true;
  EXPECT_EQ(verdict_after({{"/corpus/0/failed", Json::array({waived})}})["verdict"], "certified");
  Json waiver = {{"signature", "s"}, {"expires", "2026-01-31"}, {"expired", true}};
  expect(verdict_after({{"/waivers", Json::array({waiver})}}), "corpus", "defect", 1);
  waiver["expired"] = false;
  EXPECT_EQ(verdict_after({{"/waivers", Json::array({waiver})}})["verdict"], "certified");
}

TEST(Gates, ABrokenClaimIsADefectUnlessWaived) {
  const std::pair<const char*, Json> defect = {"/strata/0/bounds/0/defects", 1};
  const auto with = [&](bool waived) {
    return verdict_after(
        {defect, {"/failures", Json::array({failure("free-sound: missing", 1, waived)})}});
  };
  expect(with(false), "claims", "defect", 1);
  EXPECT_EQ(with(true)["verdict"], "certified");
  // Of the corpus: a matter of that gate. Any other counts, were it met in no trial.
  auto of_corpus = failure("late", 0, false);
  expect(verdict_after({{"/failures", Json::array({of_corpus})}}), "claims", "defect", 1);
  of_corpus["case"] = "corpus:1:broken:3";  // of a campaign of that name
  expect(verdict_after({{"/failures", Json::array({of_corpus})}}), "claims", "defect", 1);
  of_corpus["case"] = "corpus/M_Leither";
  EXPECT_EQ(verdict_after({{"/failures", Json::array({of_corpus})}})["verdict"], "certified");
  // A law is no claim of a trial's outcome.
  expect(verdict_after({{"/failures", Json::array({failure("law L3_X", 1, false)})}}), "claims",
         "defect", 1);
  expect(verdict_after({{"/power/worlds/0/counterexample", "pairs differ"}}), "claims", "defect",
         1);
}

TEST(Gates, BoundsAndSpeed) {
  expect(verdict_after({{"/strata/0/bounds/0/bound", 0.51}}), "bounds", "undecided", 3);
  // Where no bound is wanted none may be left open; where one is, it counts against the bound.
  expect(verdict_after({{"/strata/0/wanted_bound", nullptr}, {"/strata/0/bounds/0/undecided", 1}}),
         "bounds", "undecided", 3);
  EXPECT_EQ(verdict_after({{"/strata/0/bounds/0/undecided", 1}})["verdict"], "certified");
  expect(verdict_after({{"/times/speed/0/median", 1.31}}), "speed", "undecided", 3);
  expect(verdict_after({{"/times/speed", Json::array()}}), "speed", "undecided", 3);
  EXPECT_EQ(
      verdict_after({{"/times/speed", Json::array()}, {"/detector/built_in", false}})["verdict"],
      "certified");
}

TEST(Gates, TheFirstThatFailsNamesTheVerdict) {
  // Each gate broken in turn, from the last to the first.
  const std::vector<std::pair<const char*, Json>> changes = {
      {"/times/speed/0/median", 2},
      {"/strata/0/bounds/0/bound", 0.9},
      {"/power/worlds/0/counterexample", "c"},
      {"/corpus/0/failed",
       Json::array({{{"case", "A"}, {"signature", "s"}, {"what", "w"}, {"waived", false}}})},
      {"/campaign/missing_shards", Json::array({"1/2"})},
      {"/harness_problems", Json::array({"p"})}};
  const std::vector<std::string> gates = {"speed",  "bounds",   "claims",
                                          "corpus", "complete", "harness"};
  std::vector<std::pair<const char*, Json>> so_far;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    so_far.push_back(changes[i]);
    EXPECT_EQ(verdict_after(so_far)["failed_gate"], gates[i]);
  }
}

Json judged(Json p) {
  p["gates"] = gates_of(p);
  p.update(verdict_of(p["gates"]));
  return p;
}

bool contains(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

TEST(Junit, FailsWhereTheCertificateDoes) {
  auto p = good();
  EXPECT_FALSE(contains(junit_text(judged(p)), "<failure"));
  EXPECT_TRUE(contains(junit_text(judged(p)),
                       "<testsuite name=\"gates\" tests=\"6\" "
                       "failures=\"0\" skipped=\"0\">"));
  p["strata"][0]["bounds"][0]["defects"] = 1;
  p["strata"][0]["bounds"][0]["holds"] = 19;
  p["failures"] = Json::array({failure("free-sound: missing", 1, false)});
  const auto text = junit_text(judged(p));
  for (const std::string word :
       {"name=\"broken, bvh\">\n      <failure message=\"19 of 20 trials hold, 1 defects",
        "name=\"free-sound: missing\">\n      <failure message=\"a &amp; b &lt; c (bvh), met 1",
        "replay: assay replay x</failure>", "name=\"claims\">\n      <failure"}) {
    EXPECT_TRUE(contains(text, word)) << word << "\n" << text;
  }
  EXPECT_EQ(xml_escaped("<a b=\"c\">&\x01"), "&lt;a b=&quot;c&quot;&gt;&amp;?");
}

TEST(Summary, NamesVerdictGatesAndFailures) {
  auto p = good();
  p["failures"] = Json::array({failure("a|b", 3, false), failure("c", 0, true)});
  p["strata"][0]["bounds"][0]["defects"] = 3;
  const auto text = summary_text(judged(p));
  for (const std::string word :
       {"## Assay: defect\n", "| claims | **fails** | a\\|b (bvh), met 3 times",
        "| broken | 20 of 20 | 20 | 0 | 3 | 0 | 2.00e-01 | 5e-01 |", "\n    assay replay x\n",
        "2 of 2 planted faults found", "**c** (bvh, waived), met in the corpus alone\n",
        "All 8 bounds together hold with confidence 95 %"}) {
    EXPECT_TRUE(contains(text, word)) << word << "\n" << text;
  }
}

}  // namespace
}  // namespace assay::reports
