// The examples of help run as they stand.

#include "corpus/cases/case_file.h"
#include "reports/terminal/option_words.h"
#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

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
    if (!is_count && line.rfind("run the same again", 0) != 0 && lines.size() < 2)
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
