// Help: all verbs, and each verb with its options in groups, examples and exit codes.

#include "corpus/cases/case_file.h"
#include "reports/terminal/option_words.h"
#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The verbs that `assay help` lists.
std::vector<std::string> verbs() {
  std::vector<std::string> found;
  for (const auto& line : lines_of(run_assay("help").out)) {
    const std::regex row("^  ([a-z][-a-z]*)  +[A-Z].*");
    std::smatch match;
    if (std::regex_match(line, match, row) && match[1] != "help" && match[1] != "version")
      found.push_back(match[1]);
  }
  return found;
}

TEST(Help, IsOneTextHoweverItIsAsked) {
  const auto all = expect_ended("help", 0);
  EXPECT_EQ(run_assay("--help").out, all.out);
  EXPECT_EQ(run_assay("-h").out, all.out);
  EXPECT_EQ(verbs().size(), 11u);
  const auto run = expect_ended("help run", 0);
  EXPECT_EQ(run_assay("run --help").out, run.out);
  EXPECT_EQ(run_assay("run --campaign smoke -h").out, run.out);
  EXPECT_EQ(run_assay("version").out, run_assay("--version").out);
  expect_refused("help chekc", "unknown verb 'chekc'; did you mean check?");
  expect_refused("judge steps.log", "judge is now called check: assay check LOG");
  expect_refused("help check-queries", "is now called check: assay check QUERIES.csv");
  expect_refused("versoin", "unknown verb 'versoin'; did you mean version?");
}

TEST(Help, TheVersionNamesItsLibrariesAndItsCommit) {
  const auto version = run_assay("version").out;
  EXPECT_TRUE(version.starts_with("assay 0."));
  expect_says(version, words("CGAL GMP MPFR MPFI Eigen Boost fmt CLI11"));
  const bool has_commit =
      std::regex_search(version, std::regex("\ncommit [0-9a-f]{40}(-dirty)?\n$"));
  EXPECT_EQ(has_commit, std::filesystem::exists(ASSAY_SOURCE_DIR "/.git")) << version;
}

TEST(Help, OfEachVerbIsWholeAndFitsOnATerminal) {
  for (const auto& verb : verbs()) {
    SCOPED_TRACE(verb);
    const auto help = expect_ended("help " + verb, 0, {"\n\nUsage: assay " + verb});
    for (const std::string part : {"\nInput:\n", "\nWhat is asked:\n", "\nWhat is written:\n"}) {
      EXPECT_EQ(contains(help.out, part), contains(help.out, part + "  ")) << part << help.out;
    }
    expect_says(help.out, {"\nExamples:\n  assay " + verb, "\nExit codes:\n  0  "});
    for (const std::string word : {"TEXT", "UINT", "FLOAT", "INT ", "REQUIRED", "OPTIONS"})
      EXPECT_FALSE(contains(help.out, word)) << word << help.out;
    for (const auto& line : lines_of(help.out))
      EXPECT_TRUE(line.size() <= 80 || contains(line, "assay " + verb)) << line;
  }
}

TEST(Help, SaysTheExitCodesOfTheDesign) {
  for (const std::string help : {"help", "help check"})
    expect_ended(help, 0,
                 {"  0  all claims hold\n", "  1  a defect\n", "  2  usage or input error\n",
                  "  3  too much is undecided\n", "  4  the harness failed its own check\n",
                  "  5  collision, with --fail-on-collision\n"});
  EXPECT_FALSE(contains(run_assay("help scene").out, "  1  "));
}

TEST(Help, ShowsWordsAndDefaults) {
  expect_says(run_assay("help check").out,
              {"Usage: assay check [INPUT...] [OPTION...]\n", "--pairs WORD",
               "(default all): all, first", "--apart A,B...  "});
  expect_says(run_assay("help run").out,
              {"Usage: assay run --out DIR [OPTION...]\n", "(default quick)"});
}

TEST(Help, WordsThatAreMisspeltMeanOthers) {
  const Scratch scratch;
  const auto out = " --out " + (scratch / "out");
  expect_refused("run --campain smoke" + out,
                 "not expected: --campain smoke; did you mean --campaign? (assay run --help");
  // The option that is missing is the one that is misspelt.
  expect_refused("run --otu=" + (scratch / "out"), "did you mean --out?");
  expect_refused("run one two --seeed 3" + out,
                 "not expected: one two --seeed 3; did you mean --seed?");
  expect_refused("run --campaign smok" + out,
                 "smok: is no campaign and no file; did you mean smoke?");
  expect_refused("scene bned" + out, "no scene is named bned; did you mean bend?");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  expect_refused("list scnes", "did you mean scenes?");
  expect_refused("bench --suite stabilty", "did you mean stability?");
  expect_refused("check a.obj b.obj --culling bhv", "did you mean bvh?");
  expect_refused("run --out", "--out: DIR missing (assay run --help lists options)");
  expect_refused("check a b --jobs many", "--jobs: 'many' is not a whole number from 1 to 1024");
  expect_refused("", "name a verb (assay help lists verbs)");
}

TEST(Help, ListAloneSaysWhichListsThereAre) {
  const auto lists = expect_ended("list", 0);
  for (const std::string list : {"scenes", "laws", "faults", "campaigns"}) {
    EXPECT_TRUE(contains(lists.out, "\n" + list + " ") || lists.out.rfind(list, 0) == 0) << list;
    EXPECT_EQ(run_assay("list " + list).exit_code, 0);
  }
  expect_says(lists.out, {"\nfailures DIR ", "\nslow DIR "});
}

// The examples of help run as they stand.

namespace fs = std::filesystem;

// What the examples name and do not make: frames and queries of the reader's, a log, a plug-in.
void prepare(const Scratch& scratch) {
  const auto c = value_of(corpus::read_case(curated("A4_endpoints_only")));
  const auto export_case = expect_ended(
      "replay " + curated("A4_endpoints_only") + " --export " + (scratch / "export"), 0);
  fs::copy_file(scratch / "export/frame_0000.obj", scratch / "frame_0.obj");
  fs::copy_file(scratch / "export/frame_0001.obj", scratch / "frame_1.obj");
  fs::copy_file(std::string(ASSAY_SOURCE_DIR) + "/corpus/queries/example_vf.csv",
                scratch / "queries_vf.csv");
  fs::copy_file(plugin("always_free"), scratch / "detector.so");
  LogWriter log(scratch / "simulation.log", c.triangles, c.frames[0]);
  detector::StepResult free;
  free.answer = detector::Answer::free;
  log.step(&c.frames[0], c.frames[1], free);
  log.step(&c.frames[1], c.frames[0], free);
  log.end();
  scratch.write("tiny.json", plan_text(16));
}

// Smoke takes a minute, so a smaller campaign stands in its place.
std::string made_small(std::string command) {
  const std::string smoke = "--campaign smoke";
  const auto at = command.find(smoke);
  return at == std::string::npos ? command
                                 : command.replace(at, smoke.size(), "--campaign tiny.json");
}

// Runs a line in a folder, in a shell that finds the program. What it prints is in files of the
// scratch folder.
int code_of(const Scratch& scratch, const std::string& folder, const std::string& line) {
  return exit_code_of("cd " + folder + " && PATH=" + (scratch / "bin") + ":$PATH && { " + line +
                      "; } >" + (scratch / "out") + " 2>" + (scratch / "err") + " </dev/null");
}

struct Pasted {
  std::string folder, line;
};

// The lines to paste that are printed: `next` where one stands, what replays a failure anywhere.
// Two of a command are enough.
std::vector<Pasted> lines_to_paste(const Scratch& scratch) {
  const auto out = read_text(scratch / "out");
  const std::regex marked("(^|\n) *(next|slow cases|replay|again): (.*)");
  std::vector<Pasted> lines;
  for (std::sregex_iterator match(out.begin(), out.end(), marked), end; match != end; ++match) {
    const bool is_replay = (*match)[2] == "replay" || (*match)[2] == "again";
    const std::string line = (*match)[3];
    // `verify --again` says how many trials it ran again.
    const bool is_count = (*match)[2] == "again" && line.rfind("assay ", 0) != 0;
    if (!is_count && line.rfind("run the same command again", 0) != 0 && lines.size() < 2)
      lines.push_back({is_replay ? "/" : scratch / "", line});
  }
  return lines;
}

TEST(Examples, RunAsTheyStandAndSoDoTheLinesThatTheyPrint) {
  const Scratch scratch;
  prepare(scratch);
  fs::create_directory(scratch / "bin");
  fs::create_symlink(ASSAY_PROGRAM, scratch / "bin/assay");
  int seen = 0, pasted = 0;
  for (const auto& manual : reports::verb_manuals()) {
    for (const auto& example : manual.examples) {
      const std::string command = example.command;
      SCOPED_TRACE(command);
      EXPECT_EQ(command.rfind(std::string("assay ") + manual.verb, 0), 0u);
      ++seen;
      const int code = code_of(scratch, scratch / "", made_small(command));
      EXPECT_NE(code, 2) << read_text(scratch / "err");
      EXPECT_TRUE(contains(manual.codes, std::to_string(code)))
          << code << read_text(scratch / "out") << read_text(scratch / "err");
      for (const auto& [folder, line] : lines_to_paste(scratch)) {
        SCOPED_TRACE(line);
        ++pasted;
        const int code_of_line = code_of(scratch, folder, line);
        EXPECT_TRUE(code_of_line == 0 || code_of_line == 1 || code_of_line == 3)
            << code_of_line << read_text(scratch / "err");
      }
    }
  }
  EXPECT_GE(seen, 18);
  EXPECT_GE(pasted, 8);
}

}  // namespace
}  // namespace assay::tests
