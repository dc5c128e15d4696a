// Libraries with a part of a detector, a broad phase or an elementary query, through the program.
#include "properties/worker/plugin/query_case.h"
#include "tests/reports/json_schema.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;

class Parts : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string plan = scratch.write(
      "plan.json", plan_text(24, R"(, "shrink_share": 0.3, "policy": {"self_test_queries": 20})"));
  const std::string queries = example_queries();
  const std::string broad = " --detector " + plugin("candidates_alone");
  const std::string query = " --detector " + plugin("query_alone");

  static Outcome with(const char* variable, const std::string& words, const std::string& command) {
    ::setenv(variable, words.c_str(), 1);
    return run_assay(command);
  }
  Outcome candidates(const std::string& words, const std::string& command) const {
    return with("ASSAY_CANDIDATES", words, command + broad);
  }
  Outcome asked(const std::string& words, const std::string& command) const {
    return with("ASSAY_QUERY", words, command + query);
  }
  std::string out(const std::string& name) const { return scratch / name; }
  std::string campaign(const std::string& verb, const std::string& name) const {
    return verb + " --campaign " + plan + " --jobs 2 --out " + out(name);
  }
};

// A vertex that falls through the inside of a face: at t = 1/2.
corpus::Case query_with_a_contact() {
  detector::FourPoints query;
  query.first_group = 1;
  query.points = {{{{0.25, 0.25, 1}, {0.25, 0.25, -1}},
                   {{0, 0, 0}, {0, 0, 0}},
                   {{1, 0, 0}, {1, 0, 0}},
                   {{0, 1, 0}, {0, 1, 0}}}};
  return properties::case_of_query(query, "query");
}

void expect_valid_certificate(const std::string& file) {
  expect_certificate_schema(read_json(file));
}

TEST_F(Parts, ABroadPhaseIsCheckedByWhatItLoses) {
  const std::string check = "check " + make_scene(scratch, "folding-sheet", 200, 5) + " --json " +
                            (scratch / "report.json");
  expect_ended(
      candidates("threads=4", check + " --threads 4"), 0,
      {"\nthreads: 4", "no answer; agree", " needed, 0 lost", "candidate pairs; all claims hold"});
  EXPECT_EQ(read_json(scratch / "report.json")["outcome"], "holds");
  expect_ended(candidates("every-second", check), 1,
               {"broken: candidates", "no candidate: triangles "});
  const auto last = read_json(scratch / "report.json")["steps"].back()["diff"]["candidates"];
  EXPECT_GT(last["given"], last["least"]);
  EXPECT_GT(last["missing"].size(), 0u);
}

TEST_F(Parts, ABroadPhaseIsCertifiedAndItsMissesAreShrunk) {
  const auto right =
      expect_ended(candidates("", campaign("certify", "right")), 0,
                   {"claims: deterministic, total, candidates\n", "candidates / least"});
  EXPECT_FALSE(contains(right.out, "not judged: candidates")) << right.out;
  expect_valid_certificate(out("right") + "/certificate.json");
  const auto measures = predicate_in(out("right"))["strata"][0]["measures"]["candidates"];
  EXPECT_GT(measures["least"], 0);
  EXPECT_GT(measures["over_least"], 1);
  expect_ended(candidates("", "verify --again 1 " + out("right") + "/certificate.json"), 0);

  const auto wrong = expect_ended(candidates("ends-only", campaign("run", "wrong")), 1,
                                  {"DEFECT candidates: missing candidate, "});
  const auto lines = replay_lines(wrong.out);
  ASSERT_FALSE(lines.empty());
  expect_ended(lines[0], 1, {"DEFECT candidates: missing candidate"});
  expect_ended(
      with("ASSAY_CANDIDATES", "ends-only", "report " + out("wrong") + " --out " + out("page")), 0);
  // The page tells what is no candidate, and never that a pair is missing.
  expect_says(read_text(out("page")),
              {R"("reports_pairs":false)", R"("candidates":[)", R"("over_least":)"});
}

// A library with whole steps and a query that is wrong in its query alone.
TEST_F(Parts, AQueryIsJudgedBesideTheSteps) {
  const std::string both = " --detector " + plugin("steps_and_query");
  expect_ended(with("ASSAY_QUERY", "", campaign("certify", "both") + both), 0,
               {"\nclosed-generic ", "\nquery-ulp ", "\ncurated cases ", "\nnamed queries ",
                "; for its elementary query free-sound, "});
  expect_valid_certificate(out("both") + "/certificate.json");
  const auto stated = predicate_in(out("both"));
  EXPECT_EQ(stated["detector"]["configurations"][0]["claims"].size(), 8u);
  EXPECT_EQ(stated["detector"]["query_claims"].size(), 6u);
  EXPECT_EQ(stated["detector"]["unjudged_parts"], Json::array());
  EXPECT_EQ(stated["confidence"]["bounds"], 3 * 8 + 9 * 6);
  expect_ended(with("ASSAY_QUERY", "", "verify --again 0.2 " + out("both") + "/certificate.json"),
               0);

  const auto wrong =
      expect_ended(with("ASSAY_QUERY", "miss-coplanar", campaign("certify", "wrong") + both), 1,
                   {"verdict: defect"});
  const auto failures = predicate_in(out("wrong"))["failures"];
  ASSERT_FALSE(failures.empty());
  // Of the trials of its query, or of the corpus' named queries: none is of its steps.
  for (const auto& failure : failures)
    EXPECT_TRUE(contains(failure["case"], "query-") || contains(failure["case"], "corpus/example-"))
        << failure["case"];
  const auto lines = replay_lines(wrong.out);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(run_assay(lines[0]).exit_code, 1) << lines[0];
  EXPECT_EQ(run_assay("verify " + out("wrong") + "/certificate.json").exit_code, 1);
  // The steps by themselves hold, and the query is named as not judged; so is what is not asked.
  expect_ended(campaign("run", "steps") + both + " --part steps", 0,
               {"\nnot judged: the elementary query of this library\n"});
  const auto query_alone =
      expect_ended(with("ASSAY_QUERY", "", campaign("run", "query") + both + " --part query"), 0,
                   {"\nnot judged: the whole steps of this library\n"});
  EXPECT_FALSE(contains(query_alone.out, "\nclosed-generic "));
}

TEST_F(Parts, LabelledQueriesAreScoredAndJudged) {
  const std::string check = "check " + queries + " --json " + (scratch / "report.json");
  expect_ended(asked("", check), 0,
               {"0 false positives, 0 false negatives", "all claims hold in 5 queries"});
  const auto report = read_json(scratch / "report.json");
  EXPECT_EQ(report["method"], "query alone 1");
  EXPECT_EQ(report["detector"]["judged"], 5);
  EXPECT_EQ(report["detector"]["broken"], Json::object());

  const auto missed = expect_ended(asked("miss-inside", check), 1, {"broken: free-sound, by "});
  EXPECT_FALSE(contains(missed.out, " 0 false negatives")) << missed.out;
  expect_ended(asked("alarm", check), 1, {"broken: no-spurious, by "});
  expect_ended(asked("late=1e-6", check), 1, {"broken: not-late, by "});
  // Whoever does not claim it is not judged by it, and counted.
  const auto total_alone = expect_ended(asked("claims=128 alarm", check), 0);
  EXPECT_FALSE(contains(total_alone.out, " 0 false positives")) << total_alone.out;
  EXPECT_EQ(asked("features=edge-edge", check).exit_code, 3) << "nothing was judged";
  EXPECT_EQ(asked("undecided", check).exit_code, 3);
}

TEST_F(Parts, TheSeparationOfAContractIsThatOfItsQueries) {
  // All of them come within 3, and two have no contact.
  const std::string check = "check " + queries + " --json " + (scratch / "report.json");
  const std::string within = "separation=3 adjacency=2";
  // Labels of contact are no truth of it, unless the user says what they are.
  expect_ended(
      asked(within, check), 0,
      {"5 queries (5 within 3), 5 answers yes, 5 without a label", "all claims hold in 5 queries"});
  expect_ended(asked(within, check + " --separation 3"), 0,
               {"5 answers yes, 0 without a label", "2 disputed labels"});
  EXPECT_EQ(read_json(scratch / "report.json")["separation"], Json::array({3.0, 3.0}));
  expect_ended(asked(within + " miss-inside miss-at-start", check), 1,
               {"broken: free-sound, by 5 queries"});
  expect_refused(asked(within, check + " --separation 2"),
                 "--separation 2: query alone 1 answers for the separation of its contract, 3");
}

TEST_F(Parts, ACampaignOfQueriesIsCertifiedAndVerified) {
  expect_ended(asked("", campaign("certify", "right")), 0,
               {"216 trials of 9 families", "query-small-int", "named queries"});
  expect_valid_certificate(out("right") + "/certificate.json");
  expect_ended(asked("", "verify --again 1 " + out("right") + "/certificate.json"), 0);
}

TEST_F(Parts, AFailingQueryIsShrunkAndReplayed) {
  const auto wrong =
      expect_ended(asked("miss-inside", campaign("run", "wrong")), 1,
                   {"DEFECT free-sound: answered free, ", ": one edge-edge query\n"});
  const auto lines = replay_lines(wrong.out);
  ASSERT_FALSE(lines.empty());
  for (const auto& line : lines) expect_ended(line, 1, {"DEFECT free-sound: answered free"});
  // Simpler than it was drawn, and still the query that it says.
  const auto file = lines[0].substr(lines[0].find(' ') + 1);
  const auto smallest = read_json(file.substr(0, file.find(' ')));
  EXPECT_EQ(smallest["triangles"], Json::parse("[[0, 1, 2], [1, 3, 2]]"));
  EXPECT_TRUE(smallest["options"].contains("query"));
  const auto of_trial = asked("miss-inside", "replay tiny:1:query-constructed:0");
  EXPECT_TRUE(of_trial.exit_code == 0 || of_trial.exit_code == 1) << of_trial.out << of_trial.err;
}

TEST_F(Parts, AFailingQueryIsExportedAsPlainArrays) {
  const auto query = scratch.write("query.json", case_text(query_with_a_contact()));
  expect_ended(asked("miss-inside", "replay " + query + " --export " + out("case")), 1);
  const auto compiles = [&](const std::string& file, const std::string& more) {
    EXPECT_EQ(exit_code_of(ASSAY_COMPILER " -std=c++17 -Wall -Wextra -Werror " + out("case/") +
                           file + more + " -o " + out("program") + " 2>" + out("compiler")),
              0)
        << read_text(out("compiler"));
  };
  compiles("case.cpp", "");
  EXPECT_EQ(exit_code_of(out("program") + " >/dev/null"), 2) << "not filled in";
  auto text = read_text(out("case/case.cpp"));
  const std::string unfilled = "return found;";
  ASSERT_TRUE(contains(text, unfilled));
  EXPECT_TRUE(contains(text, "\"1/2\"")) << text;
  const auto filled = [&](const std::string& answer) {
    auto changed = text;
    changed.replace(changed.find(unfilled), unfilled.size(),
                    "found.filled_in = true; " + answer + " return found;");
    scratch.write("case/filled.cpp", changed);
    compiles("filled.cpp", "");
    return exit_code_of(out("program") + " >" + out("printed"));
  };
  EXPECT_EQ(filled("found.collision = true; found.lo = found.hi = 0.5;"), 0);
  EXPECT_EQ(filled("found.collision = true; found.lo = 0.75;"), 0) << "its time is not asked for";
  EXPECT_EQ(filled(""), 1);
  EXPECT_TRUE(says(read_text(out("printed")), "answered free, exact collision at 0.5 (1/2)"));
  compiles("case_plugin.cpp", " -I " ASSAY_SOURCE_DIR " -ldl");
  const auto judged = [&](const std::string& words) {
    return exit_code_of("ASSAY_QUERY='" + words + "' " + out("program") + " " +
                        plugin("query_alone") + " >/dev/null");
  };
  EXPECT_EQ(judged(""), 0);
  EXPECT_EQ(judged("miss-inside"), 1);
  EXPECT_EQ(judged("late=0.1"), 0);
  EXPECT_EQ(exit_code_of(out("program") + " " + plugin("candidates_alone") + " >/dev/null"), 2);
}

TEST_F(Parts, WhatAsksForAPartThatIsNotThereIsRefused) {
  expect_refused(candidates("", "check " + queries), "it answers no elementary queries");
  expect_refused(asked("", campaign("run", "steps") + " --part steps"),
                 "it answers only elementary queries");
  expect_refused(candidates("", campaign("run", "query") + " --part query"),
                 "it answers no elementary queries");
  expect_refused(asked("", "check " + curated("B1_one_vertex_own_nearest")), "only queries");
  expect_refused("replay tiny:1:query-ulp:0", "--detector");
  expect_refused(asked("claims=8", "check " + queries), "no claim about its query");
}

}  // namespace
}  // namespace assay::tests
