// If a user asks for an output file, the file is written whatever the verdict is, or is refused by
// a single line before any work.
#include <fmt/format.h>

#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Outputs : public testing::Test {
 protected:
  // Two triangles in contact, and frames that come apart.
  static std::string frame(const std::string& name, double height) {
    return scratch.write(name,
                         fmt::format("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 1 1 {0}\nv 1 2 {0}\nv 2 1 {1}\n"
                                     "f 1 2 3\nf 4 5 6\n",
                                     height, height + 1));
  }

  static inline const Scratch scratch;
  const std::string frames = frame("a.obj", 1) + " " + frame("b.obj", -0.5);
  const std::string right = scratch.write("right.csv", "1,collision,0.6\n");
  const std::string wrong = scratch.write("wrong.csv", "1,free,\n");
  const std::string plan = scratch.write("plan.json", plan_text(8));
  int folders_ = 0;

  std::string log() const {
    const auto path = scratch / "steps.log";
    write_missed_contact(path);
    return path;
  }
};

TEST_F(Outputs, ThatCannotBeWrittenAreRefusedBeforeTheWork) {
  const auto file = scratch.write("file", "");
  const auto run = scratch / "run";
  ASSERT_EQ(run_assay("run --campaign " + plan + " --out " + run).exit_code, 0);
  const std::string check = "check " + frames + " --answers " + right, judge = "check " + log();
  const std::string folders[] = {check + " --keep ",
                                 "check " + frames + " --keep ",
                                 judge + " --keep ",
                                 judge + " " + (scratch / "steps.log") + " --keep ",
                                 "run --campaign " + plan + " --out ",
                                 "certify --campaign " + plan + " --out ",
                                 "replay " + curated("A1_winding2_allpositive") + " --export ",
                                 "replay '" + log() + "#1' --export ",
                                 "scene bend --size 100 --out "};
  for (const auto& words : folders) {
    for (const auto& place : {file, file + "/below", std::string("/proc/nowhere")})
      expect_refused(words + place, place);
  }
  const std::string files[] = {check + " --json ",
                               "check " + frames + " --separation 1 --json ",
                               "check " + example_queries() + " --json ",
                               judge + " --json ",
                               judge + " --junit ",
                               judge + " " + (scratch / "steps.log") + " --junit ",
                               "report " + run + " --out ",
                               "bench --suite stability --quick --json ",
                               "bench --suite stability --quick --csv ",
                               "shrink " + curated("A1_winding2_allpositive") + " --out "};
  for (const auto& words : files) {
    for (const auto& place :
         {scratch / "", file + "/below", scratch / "absent/file", std::string("/proc/nowhere")})
      expect_refused(words + place, place);
  }
}

// The store of a run is no place for its page.
TEST_F(Outputs, APageTakesThePlaceOfNoOtherFileOfItsRun) {
  const auto run = scratch / "run", page = run + "/report.html";
  ASSERT_EQ(run_assay("run --campaign " + plan + " --out " + run).exit_code, 0);
  expect_refused("report " + run + " --out " + run + "/run.sqlite", "is an input too");
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(run_assay("report " + run + " --out " + page).exit_code, 0);
}

// A folder stands where a file of the folder has to go.
TEST_F(Outputs, AFileOfAFolderThatCannotBeWrittenIsRefusedToo) {
  const auto out = [&](const std::string& name) {
    const auto folder = scratch / std::to_string(++folders_);
    std::filesystem::create_directories(folder + "/" + name);
    return folder;
  };
  for (const auto& [words, name] : std::vector<std::pair<std::string, std::string>>{
           {"check " + frames + " --keep ", "page.html"},
           {"check " + log() + " --keep ", "page.html"},
           {"run --campaign " + plan + " --out ", "junit.xml"},
           {"run --campaign " + plan + " --out ", "summary.md"},
           {"certify --campaign " + plan + " --out ", "certificate.json"},
           {"certify --campaign " + plan + " --out ", "summary.md"}})
    expect_refused(words + out(name), name);
  const auto folder = scratch / "failures_is_a_file";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/failures") << "";
  expect_refused("run --campaign " + plan + " --out " + folder, "failures");
}

TEST_F(Outputs, TwoOutputsAreNotOneFile) {
  const auto one = scratch / "one";
  expect_refused("bench --suite stability --quick --json " + one + " --csv " + one, one);
  expect_refused("check " + log() + " --json " + one + " --junit " + one, one);
}

// Nothing fails, and nothing is there yet.
TEST_F(Outputs, AreWrittenWhateverTheVerdict) {
  for (const auto& [table, code] : {std::pair(right, 0), std::pair(wrong, 1)}) {
    const auto kept = scratch / (code == 0 ? "held/kept" : "failed/kept");
    expect_ended("check " + frames + " --answers " + table + " --keep " + kept + " --json " + kept +
                     "/r.json",
                 code);
    EXPECT_TRUE(std::filesystem::exists(kept + "/page.html"));
    EXPECT_TRUE(std::filesystem::exists(kept + "/r.json"));
    EXPECT_EQ(std::filesystem::exists(kept + "/step-1/case.json"), code == 1);
  }
  expect_ended(
      "check " + log() + " --keep " + (scratch / "x/y") + " --json " + (scratch / "x/y/r.json"), 1);
  EXPECT_TRUE(std::filesystem::exists(scratch / "x/y/page.html"));
  expect_ended("replay " + curated("A1_winding2_allpositive") + " --export " + (scratch / "p/q"),
               0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "p/q/case.json"));
}

// Where a step should go is known only when it fails; what else was asked for is written.
TEST_F(Outputs, AStepThatCannotBeKeptLosesNoReport) {
  const auto kept = scratch / "in_the_way", report = scratch / "r.json";
  std::filesystem::create_directories(kept);
  for (const char* step : {"/step-1", "/step-2"}) std::ofstream(kept + step) << "";
  const auto checked = expect_ended(
      "check " + frames + " --answers " + wrong + " --keep " + kept + " --json " + report, 2,
      {"not kept: " + kept + "/step-1"});
  EXPECT_TRUE(contains(checked.err, "step-1")) << checked.err;
  EXPECT_TRUE(contains(read_text(report), "\"outcome\": \"defect\""));
  EXPECT_TRUE(std::filesystem::exists(kept + "/page.html"));
  const auto junit = scratch / "j.xml";
  EXPECT_EQ(run_assay("check " + log() + " --keep " + kept + " --junit " + junit).exit_code, 2);
  EXPECT_TRUE(contains(read_text(junit), "<failure"));
}

// A file of the user's beside an output stays as it is.
TEST_F(Outputs, NothingElseIsTouched) {
  const auto report = scratch / "mine.json";
  const auto mine = scratch.write("mine.json.probe", "mine");
  EXPECT_EQ(run_assay("check " + frames + " --json " + report).exit_code, 0);
  EXPECT_EQ(read_text(mine), "mine");
}

}  // namespace
}  // namespace assay::tests
