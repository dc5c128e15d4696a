// The examples of help run as they stand.
#include "corpus/cases/case_file.h"
#include "reports/terminal/manual.h"
#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;

// What the examples name and do not make: frames and queries of the reader's, a log, a plug-in.
void prepare(const Scratch& scratch) {
  const auto read = corpus::parse_case(read_text(curated("A4_endpoints_only")), "A4");
  ASSERT_TRUE(read);
  const auto& c = read.value();
  const auto export_case =
      run_assay("replay " + curated("A4_endpoints_only") + " --export " + (scratch / "export"));
  ASSERT_EQ(export_case.exit_code, 0) << export_case.err;
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
  // The set takes minutes; vectors_are_made and vectors_hold run these two verbs.
  fs::create_directory(scratch / "vectors");
  fs::copy(std::string(ASSAY_SOURCE_DIR) + "/corpus/vectors", scratch / "vectors",
           fs::copy_options::recursive);
  scratch.write("tiny.json", plan_text(16));
}

// Smoke takes a minute, so a smaller campaign stands in its place.
std::string made_small(std::string command) {
  const std::string smoke = "--campaign smoke";
  const auto at = command.find(smoke);
  return at == std::string::npos ? command
                                 : command.replace(at, smoke.size(), "--campaign tiny.json");
}

TEST(Examples, RunAsTheyStand) {
  const Scratch scratch;
  prepare(scratch);
  fs::create_directory(scratch / "bin");
  fs::create_symlink(ASSAY_PROGRAM, scratch / "bin/assay");
  int seen = 0;
  for (const auto& verb : reports::verbs_with_examples()) {
    const auto manual = reports::manual_of(verb, "");
    for (const auto& [command, about] : manual.examples) {
      SCOPED_TRACE(command);
      EXPECT_EQ(command.rfind("assay " + verb, 0), 0u);
      ++seen;
      if (verb == "vectors" || verb == "verify-vectors") continue;
      const auto line = "cd " + (scratch / "") + " && PATH=" + (scratch / "bin") + ":$PATH && " +
                        made_small(command) + " >out 2>err </dev/null";
      const int status = std::system(line.c_str());
      ASSERT_TRUE(WIFEXITED(status));
      const int code = WEXITSTATUS(status);
      EXPECT_NE(code, 2) << read_text(scratch / "err");
      EXPECT_TRUE(std::any_of(manual.exit_codes.begin(), manual.exit_codes.end(),
                              [&](const auto& known) { return known.first == code; }))
          << code << read_text(scratch / "out") << read_text(scratch / "err");
    }
  }
  EXPECT_GE(seen, 18);
}

}  // namespace
}  // namespace assay::tests
