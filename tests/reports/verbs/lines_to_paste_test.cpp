// Each line to paste that a verb prints or writes contains all of its inputs: pasted into a shell,
// even in another folder, it gives the same verdict.
#include <fmt/format.h>

#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// A folder whose name a shell would take for two words.
class LinesToPaste : public testing::Test {
 protected:
  static std::string file(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << text;
    return "'" + name + "'";
  }
  // A triangle, and one that falls through it.
  static std::string lower() { return "v 0 0 0\nv 9 0 0\nv 0 9 0\n"; }
  static std::string upper(double z) {
    return fmt::format("v 1 1 {0}\nv 1 2 {0}\nv 2 1 {1}\n", z, z + 1);
  }

  void SetUp() override {
    const std::string face = "f 1 2 3\n";
    file("a 0.obj", lower() + face), file("b 0.obj", upper(1) + face);
    file("b 1.obj", upper(-0.5) + face);
    const std::string faces = face + "f 4 5 6\n";
    file("f 0.obj", lower() + upper(1) + faces), file("f 1.obj", lower() + upper(-0.5) + faces);
    file("f 2.obj", lower() + upper(1) + faces);
    file("free.csv", "1,free,\n"), file("late.csv", "1,collision,0.9\n");
  }

  // Runs the program in the folder.
  static Outcome run(const std::string& words, const std::string& before = "") {
    return run_assay(words, "cd '" + folder.string() + "' && " + before);
  }

  static int code_of(const std::string& line, const std::string& where) {
    return exit_code_of("cd '" + where + "' && " + line + " >/dev/null");
  }

  // Pastes all lines of the text: `next` in its folder, the others anywhere.
  static void expect_same(const std::string& text, int code, std::size_t least) {
    const std::regex marked("(^|\n) *(next|again|replay): ([^\n]*)");
    std::size_t pasted = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), marked), end; match != end; ++match) {
      const std::string line = (*match)[3];
      EXPECT_EQ(code_of(line, (*match)[2] == "next" ? folder.string() : "/"), code) << line;
      ++pasted;
    }
    EXPECT_GE(pasted, least) << text;
  }

  static inline const Scratch scratch;
  static inline const std::filesystem::path folder = scratch / "my frames";
};

TEST_F(LinesToPaste, OfCheckNameFramesBodiesAndAnswers) {
  const std::string bodies = "--body 'a 0.obj' --body 'b 0.obj' 'b 1.obj'";
  const std::string inputs[] = {
      "'f 0.obj' 'f 1.obj' --answers free.csv",
      "'f 0.obj' 'f 1.obj' --answers=late.csv --adjacency no-shared-vertex",
      "'f 0.obj' 'f 1.obj' 'f 2.obj' --answers free.csv",
      bodies + " --answers free.csv",
      bodies + " --answers late.csv --apart 0,0",
      bodies + " --detector " + plugin("always_free"),
      bodies + " --detector " + plugin("always_free") + " --isolation limits --threads 2",
      "'f 0.obj' 'f 1.obj' --detector " + plugin("always_free")};
  int number = 0;
  for (const auto& input : inputs) {
    SCOPED_TRACE(input);
    expect_same(expect_ended(run("check " + input), 1).out, 1, 1);
    const auto kept = folder / fmt::format("kept {}", ++number), report = kept / "r.json";
    const auto made = expect_ended(run(fmt::format("check {} --keep '{}' --json '{}'", input,
                                                   kept.filename().string(), report.string())),
                                   1);
    expect_same(made.out, 1, contains(input, "--detector") ? 2 : 1);
    // The same lines stand in the report and on the page, and the kept case names all files.
    const auto step = read_json(report).at("kept").at(0);
    const auto page = read_text(kept / "page.html");
    for (const char* line : {"again", "replay"}) {
      const auto text = step.at(line).get<std::string>();
      EXPECT_TRUE(text.empty() || contains(made.out, text)) << text;
      EXPECT_EQ(text.empty() ? 1 : code_of(text, "/"), 1) << text;
    }
    EXPECT_TRUE(contains(page, "<pre>cd ")) << page;
    const std::string source = read_json(kept / "step-1" / "case.json").at("source");
    for (const std::string name :
         {"a 0.obj", "b 0.obj", "b 1.obj", "f 0.obj", "f 1.obj", "free.csv", "late.csv"})
      EXPECT_EQ(contains(source, name), contains(input, name)) << source;
  }
}

TEST_F(LinesToPaste, OfACaseFileKeepItsRelation) {
  // The pair does not count, so that nothing fails; with the relation lost it would.
  const auto text = [](const char* apart, const char* step) {
    return fmt::format(R"({{"schema": "assay-case/1", "id": "x", "about": "", "source": "",
      "triangles": [[0, 1, 2], [3, 4, 5]],
      "frames": [[[0, 0, 0], [9, 0, 0], [0, 9, 0], [1, 1, 1], [1, 2, 1], [2, 1, 2]],
                 [[0, 0, 0], [9, 0, 0], [0, 9, 0], [1, 1, -1], [1, 2, -1], [2, 1, 0]]],
      "counted": {{"level": "triangles", "bodies": [[3, 0], [3, 1]], "apart": [{}], "steps": [{}]}},
      "options": {{}}, "expected": {{"steps": []}}, "pending": {{}}}})",
                       apart, step);
  };
  file("apart.json", text("[0, 1]", R"({"answer": "free"})"));
  file("met.json",
       text("[0, 0]",
            R"({"answer": "collision", "first_time": [0.5, 0.5], "pairs": [[0, 1, 0.5, 0.5]]})"));
  EXPECT_EQ(run("check apart.json --detector " + plugin("takes_relations")).exit_code, 0);
  const auto made = expect_ended(
      run("check met.json --detector " + plugin("always_free") + " --keep 'of case'"), 1);
  expect_same(made.out, 1, 2);
}

TEST_F(LinesToPaste, OfCheckNameTheLogAndTheStep) {
  write_missed_contact((folder / "my log").string());
  for (const std::string word : {"'my log'", "'my log#2'"})
    expect_same(expect_ended(run("check " + word + " --keep judged"), 1).out, 1, 1);
  const auto shrunk =
      expect_ended(run("shrink 'my log#2' --out 'small one.json' --isolation limits --detector " +
                       plugin("always_free")),
                   1, {" --isolation limits"});
  expect_same(shrunk.out, 1, 1);
}

TEST_F(LinesToPaste, OfRunsAndSelfTestsNameTheDetectorAsItRan) {
  file("plan.json", plan_text(8));
  const std::string detector =
      " --detector " + plugin("always_free") + " --isolation limits --threads 2";
  const auto ran = expect_ended(run("run --campaign plan.json --out 'my run'" + detector), 1);
  const auto listed = run("list failures 'my run'");
  for (const auto& text : {ran.out, listed.out}) {
    const auto lines = replay_lines(text);
    ASSERT_FALSE(lines.empty()) << text;
    for (const auto& line : lines) {
      EXPECT_TRUE(contains(line, " --isolation limits --threads 2")) << line;
      EXPECT_EQ(run_assay(line).exit_code, 1) << line;
    }
  }
}

// What fails only because of what the process did before is not shown by its own case.
TEST_F(LinesToPaste, WhatItsOwnCaseDoesNotShowSaysSo) {
  const std::string detector = " --detector " + plugin("steps_and_query");
  const std::string state = "ASSAY_QUERY='claims=129 free-after-calls=2' ";
  const std::string check =
      "check 'f 0.obj' 'f 1.obj' 'f 2.obj' 'f 1.obj' --keep state --json state/r.json";
  EXPECT_EQ(run(check + " --part steps" + detector, state).exit_code, 2) << "check has no parts";
  const auto made = expect_ended(run(check + detector, state), 1,
                                 {"not reproduced: in a new process that answers only this step"});
  EXPECT_FALSE(contains(made.out, "replay: ")) << made.out;
  EXPECT_EQ(read_json(folder / "state/r.json").at("kept").at(0).at("reproduced"), false);
  EXPECT_TRUE(contains(read_text(folder / "state/page.html"), "not reproduced"));
  ::setenv("ASSAY_QUERY", "claims=129 free-after-calls=2", 1);
  expect_same(made.out, 1, 1);
  ::unsetenv("ASSAY_QUERY");

  expect_ended(run("check --json q.json " + example_queries() + detector, state), 1,
               {"its case alone gives another result"});
  EXPECT_TRUE(contains(read_text(folder / "q.json"), "its case alone gives another result"));

  file("plan.json", plan_text(8));
  expect_ended(run("run --campaign plan.json --jobs 1 --part steps --out stateful" + detector,
                   "ASSAY_QUERY='claims=129 free-after-calls=20' "),
               1, {"its case alone gives another result"});
  EXPECT_TRUE(contains(read_text(folder / "stateful/junit.xml"), "gives another result"));
  EXPECT_EQ(run("report stateful --out page.html").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder / "page.html"), "\"flaky\":true"));
}

}  // namespace
}  // namespace assay::tests
