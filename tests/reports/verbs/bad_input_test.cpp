// Bad input causes one clear line on stderr, exit code 2, and nothing else.
#include "detector/options.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

const char* const tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

void expect_brief_refusal(const std::string& arguments, const std::string& word) {
  SCOPED_TRACE(arguments);
  const Outcome outcome = run_assay(arguments);
  expect_refused(outcome, word);
  EXPECT_LT(outcome.err.size(), 400u);
}

class BadInput : public testing::Test {
 protected:
  std::string good = scratch.write("good.obj", tetrahedron);
  std::string check_with_good(const std::string& path) { return "check " + good + " " + path; }
  // A file given as the second frame.
  void expect_bad_frame(const std::string& name, const std::string& text, const std::string& word) {
    expect_brief_refusal(check_with_good(scratch.write(name, text)), word);
  }
  static inline const Scratch scratch;
};

// What may be wrong with the bytes of a file, and with which words that is said, is tested where
// they are read (tests/corpus); here is that the program says it.
TEST_F(BadInput, FilesThatCannotBeRead) {
  expect_brief_refusal(check_with_good(scratch / "missing.obj"), "missing.obj");
  expect_bad_frame("empty.obj", "", "empty");
  expect_brief_refusal("check " + good + " /tmp", "directory");
  expect_bad_frame("mesh.xyz", tetrahedron, "mesh.xyz");
  expect_bad_frame("noise.ply", std::string("\x7f\x01\xfe noise \x00 more", 16), "noise.ply");
  expect_bad_frame("noise.obj.gz", "this is no gzip", "noise.obj.gz");
  expect_bad_frame("five.obj", std::string(tetrahedron) + "v 9 9 9\n", "vert");
  const auto twice = scratch.write("twice.obj", std::string(tetrahedron) + "f 3 1 2\n");
  expect_brief_refusal("check " + twice + " " + twice, "same three vertices (lines 5 and 9)");
}

TEST_F(BadInput, PipesAndDevices) {
  expect_brief_refusal(check_with_good("/dev/zero"), "not a regular file");
  const std::string pipe = scratch / "pipe.obj";
  ASSERT_EQ(std::system(("mkfifo " + pipe).c_str()), 0);
  expect_brief_refusal(check_with_good(pipe), "not a regular file");
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  const std::string program = ASSAY_PROGRAM;
  EXPECT_EQ(exit_code_of(program + " list scenes >/dev/full 2>/dev/null"), 2);
  EXPECT_EQ(exit_code_of(program + " frobnicate 2>/dev/full"), 2);
  EXPECT_EQ(exit_code_of(program + " frobnicate 2>&-"), 2);
}

TEST_F(BadInput, StaleFramesOfALongerScene) {
  const std::string scene = "scene bend --size 100 --out " + (scratch / "stale") + " --frames ";
  for (int times = 0; times < 2; ++times) expect_ended(scene + "4", 0);
  expect_brief_refusal(scene + "2", "earlier run");
}

TEST_F(BadInput, QueryFiles) {
  std::string eight_rows;
  for (int i = 0; i < 8; ++i) eight_rows += "0,1,0,1,0,1\n";
  expect_brief_refusal("check " + scratch.write("unnamed.csv", eight_rows), "unnamed.csv");
  const auto eight = scratch.write("8ee.csv", eight_rows);
  const auto truths = scratch.write("truth.json", "[true,false]");
  expect_brief_refusal("check " + eight + " --truth " + truths, "truth.json");
  expect_brief_refusal("check " + eight + " --truth " + truths + " " + truths, "2 truth files");
  expect_brief_refusal("check " + eight + " --method guess", "guess");
}

TEST_F(BadInput, CaseFiles) {
  std::string text = read_text(curated("A4_endpoints_only"));
  const std::string known = "\"culling\": \"view-point\"";
  ASSERT_NE(text.find(known), std::string::npos);
  text.replace(text.find(known), known.size(), "\"culling\": \"fast\"");
  expect_brief_refusal("check " + scratch.write("option.json", text), "fast");
  expect_brief_refusal("check " + scratch.write("broken.json", "{\"schema\": "), "broken.json");
}

TEST_F(BadInput, Options) {
  expect_brief_refusal("frobnicate", "frobnicate");
  expect_brief_refusal("check " + good + " " + good + " --culling fast",
                       "view-auto, view-point, view-line, normal-cone, bvh, none");
  expect_brief_refusal("check " + good + " " + good + " --start maybe", "maybe");
  expect_brief_refusal("check " + good + " " + good + " --pairs some", "some");
  expect_brief_refusal("check " + good + " " + good + " --jobs 0", "jobs");
  expect_brief_refusal("check " + good + " " + good + " --time -3", "time");
  expect_brief_refusal("check " + good + " " + good + " --json -", "-: name a file");
  expect_brief_refusal("chekc " + good, "unknown verb 'chekc'; did you mean check?");
  for (const std::string size : {"lots", "-1", "0", "GB", "1.5GB", "99999999999999999999", "6TB"})
    expect_brief_refusal("check " + good + " " + good + " --memory " + size, "memory");
  expect_brief_refusal("check " + good + " " + good + " --time inf", "time");
  expect_brief_refusal("check " + good + " " + good + " --json " + good, "input");
  expect_brief_refusal("check " + good + " " + good + " --json /dev/null", "regular file");
  expect_brief_refusal("check " + good + " " + good + " --no-oracle=banana", "no-oracle");
  expect_brief_refusal("'two\nlines'", "two?lines");
  expect_brief_refusal("scene bend --size 100000000 --frames 1000 --out " + (scratch / "x"),
                       "8 GB");
  expect_brief_refusal("scene bend --mesh " + good + " --size 10 --out " + (scratch / "x"),
                       "--size");
  expect_brief_refusal("scene nowhere --out " + (scratch / "x"), "breathing-sphere");
  expect_brief_refusal("scene bend", "--out");
  expect_brief_refusal("scene bend --frames 0 --out " + (scratch / "x"), "frames");
  expect_brief_refusal("scene open-tube --mesh " + good + " --out " + (scratch / "x"), "open-tube");
}

}  // namespace
}  // namespace assay::tests
