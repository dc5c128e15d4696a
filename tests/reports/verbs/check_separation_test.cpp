// `assay check --separation` on the command line, for meshes and for queries: two triangles and a
// query whose distance is known.
#include "reports/check/check_run.h"
#include "tests/reports/program.h"
#include "tests/sinking_corner.h"

namespace assay::tests {
namespace {

using json = nlohmann::ordered_json;

// A triangle at rest in the plane z = 0 and one above it, whose corner moves from z = 3 to z = 1
// above the inside of the first; its other two corners are at z = 4.
class SeparationCommand : public testing::Test {
 protected:
  std::string frame(const std::string& name, const std::string& z) {
    return scratch.write(
        name, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 " + z + "\nv 2 1 4\nv 1 2 4\nf 1 2 3\nf 4 5 6\n");
  }
  Outcome check(const std::string& options) {
    return run_assay("check " + frame("a.obj", "3") + " " + frame("b.obj", "1") + " " + options);
  }
  const Scratch scratch;
};

TEST_F(SeparationCommand, SaysWhenFirstAndHowNear) {
  expect_ended(check("--separation 2 --json " + (scratch / "r.json")), 0,
               {"step 1: near at t = 0.5, 1 pair\n",
                "least distance 1: triangles 0 and 1 at t = 1 (vertex-face)",
                "near at t = 0.5 of step 1; least distance 1\n"});
  const auto report = read_json(scratch / "r.json");
  EXPECT_EQ(report["separation"], 2.0);
  EXPECT_EQ(report["outcome"], "near");
  const auto& step = report["steps"][0];
  EXPECT_EQ(step["answer"], "near");
  EXPECT_EQ(step["first_time"], json::array({0.5, 0.5}));
  EXPECT_EQ(step["near_at_start"], 0);
  EXPECT_EQ(step["least_distance"], 1.0);
  EXPECT_EQ(step["pairs"].size(), 1u);
}

TEST_F(SeparationCommand, TellsADistanceFromTheDoubleBelowIt) {
  EXPECT_TRUE(says(check("--separation 1").out, "near at t = 1 of step 1"));
  EXPECT_TRUE(says(check("--separation 0.9999999999999999").out,
                   "apart: never within 0.9999999999999999; least distance 1\n"));
  EXPECT_TRUE(says(check("--separation 3").out, "1 near at the start"));
}

TEST_F(SeparationCommand, OffsetsOfTwoBodiesAddUp) {
  const auto body = [&](const std::string& name, const std::string& z, const std::string& tip) {
    return scratch.write(name, "v 0 0 " + z + "\nv 4 0 " + z + "\nv 1 1 " + tip + "\nf 1 2 3\n");
  };
  const std::string bodies = "check --body " + body("below.obj", "0", "0") + " --body " +
                             body("high.obj", "4", "3") + " " + body("low.obj", "4", "1") + " ";
  expect_ended(bodies + "--offset 0.5 --offset 1.5 --json " + (scratch / "r.json"), 0,
               {"step 1: near at t = 0.5, 1 pair\n"});
  const auto report = read_json(scratch / "r.json");
  EXPECT_EQ(report["offsets"], json::array({0.5, 1.5}));
  EXPECT_TRUE(report["separation"].is_null());
  EXPECT_TRUE(says(run_assay(bodies + "--offset 0 --offset 0.5").out,
                   "apart: never within the sum of two bodies' offsets; least distance 1\n"));
  EXPECT_TRUE(says(run_assay(bodies + "--offset 1").err, "1 offsets for 2 bodies"));
}

TEST_F(SeparationCommand, TheExitCodeSaysWhatIsAskedFor) {
  EXPECT_EQ(check("--separation 2 --fail-on-collision").exit_code, 5);
  EXPECT_EQ(check("--separation 0.5 --fail-on-collision").exit_code, 0);
  for (const std::string wrong : {"-1", "nan", "1e999", "x"})
    expect_one_line(check("--separation " + wrong));
}

TEST_F(SeparationCommand, TheLeastDistanceOfAnUndecidedRunIsNotKnown) {
  const std::vector<std::string> files = {frame("a.obj", "3"), frame("b.obj", "1"),
                                          frame("c.obj", "0.5")};
  for (const bool stops : {false, true}) {
    auto input = std::move(reports::read_check_input(files).value());
    reports::CheckQuestion question;
    question.files = files;
    question.wants_report = true;
    question.distance = reports::AskedDistance{2, {}};
    std::string told;
    const auto answer =
        value_of(reports::check_mesh(question, input, "",
                                     {[&](const std::string& text) { told += text; },
                                      [&] { return stops && contains(told, "step 1: near"); }}));
    EXPECT_EQ(answer.report["steps"][0]["least_distance"], 1.0);
    EXPECT_EQ(answer.report["least_distance"], stops ? json() : json(0.5)) << told;
    EXPECT_NE(contains(told, "of step 1; least distance"), stops) << told;
    EXPECT_EQ(answer.outcome.exit_code(false), stops ? 3 : 0);
  }
}

// A case may state a separation among its options: then all verbs ask for it.
TEST_F(SeparationCommand, TheSeparationOfACaseIsWhatEveryVerbAsks) {
  const std::map<std::string, std::string, std::less<>> bvh = {{"culling", "bvh"}};
  auto within = bvh;
  within["separation"] = "2";
  const auto file = scratch.write("within.json", corpus::case_text(sinking_corner(1, within)));
  expect_ended(
      "check " + file + " --json " + (scratch / "r.json"), 0,
      {"; culling bvh, within 2\n", "step 1: collision at t = 0.5, 1 pair within 2; agree\n",
       "collision at t = 0.5 of step 1; detector and oracle agree"});
  EXPECT_EQ(json::parse(read_text(scratch / "r.json"))["separation"], 2.0);
  expect_ended("replay " + file, 0, {"oracle collision at t = 0.5, 1 pair within 2\n"});
  expect_ended("shrink " + file + " --out " + (scratch / "small.json"), 0);
  // Without one it is asked for contacts.
  const auto contacts = scratch.write("contacts.json", corpus::case_text(sinking_corner(1, bvh)));
  expect_ended("check " + contacts + " --json " + (scratch / "r.json"), 0, {"; culling bvh\n"});
  EXPECT_EQ(json::parse(read_text(scratch / "r.json"))["separation"], 0.0);
  EXPECT_TRUE(says(run_assay("replay " + contacts).out, "oracle free\n"));
}

class QueriesWithin : public testing::Test {
 protected:
  // A vertex that sinks from z = 3 to z = 1 above the inside of a face at rest.
  static std::string rows(const std::string& ending) {
    std::string text;
    for (const char* vertex : {"1,1,1,1,3,1", "1,1,1,1,1,1"}) {
      for (const char* row : {vertex, "0,1,0,1,0,1", "4,1,0,1,0,1", "0,1,4,1,0,1"})
        text += row + ending + "\n";
    }
    return text;
  }
  Outcome check(const std::string& text, const std::string& options) const {
    return run_assay("check " + scratch.write("vf.csv", text) + " --json " + (scratch / "q.json") +
                     " " + options);
  }
  json report() const { return read_json(scratch / "q.json"); }
  const Scratch scratch;
};

TEST_F(QueriesWithin, EveryMethodThatKnowsDistanceTellsItFromTheDoubleBelow) {
  for (const std::string method : {"oracle", "referee", "detector-exact"}) {
    SCOPED_TRACE(method);
    expect_ended(check(rows(",1"), "--separation 1 --method " + method), 0,
                 {method + ": 1 queries (1 within 1), 1 answers yes, 0 without a label"});
    EXPECT_EQ(report()["separation"], json::array({1.0, 1.0}));
    EXPECT_EQ(report()["yes"], 1);
    expect_ended(check(rows(",0"), "--separation 0.9999999999999999 --method " + method), 0);
    EXPECT_EQ(report()["yes"], 0);
    EXPECT_EQ(report()["open"], 0);
    // Distance 0 is contact.
    EXPECT_EQ(check(rows(",0"), "--separation 0 --method " + method).exit_code, 0);
    EXPECT_EQ(check(rows(",0"), "--method " + method).exit_code, 0);
    EXPECT_EQ(report()["separation"], nullptr);
  }
}

TEST_F(QueriesWithin, RowsWithASeparationGoBeforeTheOption) {
  const auto text = rows(",0,0.5") + rows(",1,2") + rows(",1,0.75") + rows(",1");
  expect_ended(check(text, "--separation 1"), 1,
               {"oracle: 4 queries (4 within 0.5 to 2), 2 answers yes",
                "vf.csv query 2 within 0.75: answer false, label true\n"});
  EXPECT_EQ(report()["separation"], json::array({0.5, 2.0}));
  EXPECT_EQ(report()["differences"][0]["separation"], 0.75);
  // Without the option a row that says none asks for contact.
  expect_ended(
      check(rows(",1,2") + rows(",1"), ""), 1,
      {"2 queries (1 within 2), 1 answers yes", "vf.csv query 1: answer false, label true\n"});
  EXPECT_EQ(report()["differences"][0]["separation"], nullptr);
}

TEST_F(QueriesWithin, WhatKnowsNoDistanceIsRefusedInOneLine) {
  for (const std::string method : {"detector-bounded", "detector-double", "detector-float"}) {
    SCOPED_TRACE(method);
    const auto asked = "--method " + method, knows_none = asked + " knows no separation";
    expect_one_line(check(rows(",1"), "--separation 1 " + asked), "query 0: " + knows_none);
    expect_one_line(check(rows("") + rows(",1,2"), asked), "query 1: " + knows_none);
  }
  for (const std::string word : {"-1", "nan", "1e999", "x"})
    expect_one_line(check(rows(",1"), "--separation=" + word), "--separation");
}

}  // namespace
}  // namespace assay::tests
