// Checks of the oracle itself on the command line: the self-test, the second opinion, the referee.
#include "reports/steps/step_report.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

TEST(SelfTestCommand, HoldsAndSaysSeedAndCounts) {
  expect_ended("self-test --queries 100 --seed 7 --jobs 2", 0,
               {"seed 7", "small-int ", "cube-2 ", "left out", "steps ", "quadratic %",
                "no contradiction in"});
}

TEST(SelfTestCommand, ReplaysACaseExactly) {
  expect_ended(
      "self-test --replay dyadics:1:4", 0,
      {"vertex-face", "0x1", "oracle, timed: ", "detector, integers alone: ", "second referee: "});
  for (const std::string family : {"rungs", "steps", "plane-2"})
    EXPECT_EQ(run_assay("self-test --replay " + family + ":1:0").exit_code, 0);
}

TEST(SelfTestCommand, TimeLimitIsUndecided) {
  expect_ended("self-test --queries 1000000 --time 0.2", 3, {"undecided"});
}

TEST(SelfTestCommand, BadInputIsOneLine) {
  for (const char* arguments :
       {"--replay x", "--replay small-int:1", "--queries 0", "--time -1", "--seed x", "--jobs 0"})
    expect_refused(std::string("self-test ") + arguments, "");
}

class SecondOpinionRun : public testing::Test {
 protected:
  auto check(const std::string& arguments) const {
    expect_ended("check " + arguments + " --json " + (scratch / "r.json"), 0, {"second opinion: "});
    return read_json(scratch / "r.json");
  }
  const Scratch scratch;
};

TEST_F(SecondOpinionRun, WholeScenesWithoutAContradiction) {
  for (const std::string scene : {"folding-sheet", "crumpling-sphere", "pinching-torus"}) {
    const auto report = check(make_scene(scratch, scene, 200, 4) + " --second-opinion 1");
    for (const auto& step : report["steps"]) {
      const auto& opinion = step["second_opinion"];
      EXPECT_EQ(opinion["share"], 1.0);
      EXPECT_EQ(opinion["complete"], true);
      EXPECT_EQ(opinion["queries"], step["oracle"]["feature_candidates"]);
      EXPECT_EQ(opinion["contradictions"].size(), 0u);
      EXPECT_LE(opinion["open"].get<double>(), 0.05 * opinion["queries"].get<double>());
    }
  }
}

TEST_F(SecondOpinionRun, AShareIsTheSameForAnyJobs) {
  const auto frames = make_scene(scratch, "crumpling-sphere", 500, 2);
  const auto ask = [&](const std::string& jobs) {
    auto opinion =
        check(frames + " --second-opinion 0.1 --jobs " + jobs)["steps"][0]["second_opinion"];
    opinion.erase("time_ms");
    return opinion;
  };
  const auto one = ask("1");
  EXPECT_GT(one["queries"], 0);
  EXPECT_EQ(one, ask("3"));
}

TEST_F(SecondOpinionRun, NullWithoutTheOption) {
  expect_ended("check " + make_scene(scratch, "bend", 200, 2) + " --json " + (scratch / "n.json"),
               0);
  EXPECT_EQ(read_json(scratch / "n.json")["steps"][0].at("second_opinion"), nullptr);
}

TEST_F(SecondOpinionRun, BadSharesAreRefusedInOneLine) {
  for (const std::string share : {"0", "-1", "1.5", "nan", "inf", "half", "\"\"", "0.5x"})
    expect_refused("check a.ply b.ply --second-opinion " + share, "second-opinion");
}

TEST_F(SecondOpinionRun, RefereeAnswersQueries) {
  // A vertex that falls through a face at t=1/2, and one that misses it, labelled wrongly as a
  // contact too.
  const auto rows = [](const std::string& x) {
    std::string text;
    for (const std::string z : {"1", "-1"})
      text += x + ",1,1,1," + z + ",1,1\n0,1,0,1,0,1,1\n4,1,0,1,0,1,1\n0,1,4,1,0,1,1\n";
    return text;
  };
  std::filesystem::create_directory(scratch / "vertex-face");
  const auto file = scratch.write("vertex-face/two.csv", rows("1") + rows("9"));
  const auto outcome =
      expect_ended("check --method referee " + file + " --json " + (scratch / "q.json"), 1,
                   {"0 open, 0 contradictions"});
  EXPECT_FALSE(says(outcome.out, "rungs"));
  const auto report = read_json(scratch / "q.json");
  EXPECT_EQ(report["method"], "referee");
  EXPECT_EQ(report["count"], 2);
  EXPECT_EQ(report["yes"], 1);
  EXPECT_EQ(report["open"], 0);
  EXPECT_EQ(report["contradictions"], 0);
  EXPECT_EQ(report["false_negatives"], 1);
  EXPECT_EQ(report["rungs"], nullptr);
}

// No input makes the two disagree, so what is printed of a contradiction is tested alone.
TEST(SecondOpinionText, NamesTheContradictions) {
  oracle::SecondOpinion opinion;
  opinion.complete = true;
  opinion.queries = 9;
  opinion.contact = 3;
  opinion.no_contact = 5;
  opinion.open = 1;
  opinion.static_checks = 20;
  opinion.contradictions = {{oracle::ContradictionKind::query,
                             {detector::FeatureKind::vertex_face, {7, 0, 1, 2, -1}},
                             {-1, -1},
                             {},
                             false,
                             true},
                            {oracle::ContradictionKind::static_pair,
                             {},
                             {4, 6},
                             oracle::RationalTime{1, 3},
                             false,
                             true}};
  const std::string text = reports::second_opinion_text(opinion, 2);
  expect_says(text, {"9 queries (3 contact, 5 no contact, 1 open), 20 static checks, 2 contra",
                     "vertices 7 0 1 2; oracle: no contact, referee: contact",
                     "triangles 4 and 6 at t = 1/3"});
  const auto report = reports::second_opinion_json(opinion, .25, 2);
  EXPECT_EQ(report["contradictions"].size(), 2u);
  EXPECT_EQ(report["contradictions"][0]["kind"], "query");
  EXPECT_EQ(report["contradictions"][1]["time"], "1/3");
  EXPECT_EQ(report["share"], .25);
}

}  // namespace
}  // namespace assay::tests
