// Bad input gets one clear line on stderr and exit code 2, nothing else.
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

TEST_F(BadInput, FilesThatCannotBeRead) {
  expect_brief_refusal(check_with_good(scratch / "missing.obj"), "missing.obj");
  expect_bad_frame("empty.obj", "", "empty");
  expect_brief_refusal("check " + good + " /tmp", "directory");
  expect_bad_frame("mesh.xyz", tetrahedron, "mesh.xyz");
  expect_bad_frame("noise.ply", std::string("\x7f\x01\xfe noise \x00 more", 16), "noise.ply");
  expect_bad_frame("noise.obj.gz", "this is no gzip", "noise.obj.gz");
}

TEST_F(BadInput, NoPermission) {
  const auto path = scratch.write("secret.obj", tetrahedron);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  for (const auto& open : {scratch / "", good}) {
    std::filesystem::permissions(
        open, std::filesystem::perms::others_read | std::filesystem::perms::others_exec,
        std::filesystem::perm_options::add);
  }
  const Outcome outcome = run_assay(check_with_good(path), not_by_root());
  expect_problem(outcome, "secret.obj");
  expect_problem(outcome, "ermission");
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
  const std::string folder = scratch / "stale";
  ASSERT_EQ(run_assay("scene bend --size 100 --frames 4 --out " + folder).exit_code, 0);
  ASSERT_EQ(run_assay("scene bend --size 100 --frames 4 --out " + folder).exit_code, 0);
  expect_brief_refusal("scene bend --size 100 --frames 2 --out " + folder, "earlier run");
}

TEST_F(BadInput, TruncatedFiles) {
  ASSERT_EQ(run_assay("scene breathing-sphere --size 80 --frames 2 --out " + (scratch / "sphere"))
                .exit_code,
            0);
  const std::string frame = scratch / "sphere/frame_0000.ply", whole = read_text(frame);
  const auto cut = scratch.write("cut.ply", whole.substr(0, whole.size() - 20));
  expect_brief_refusal("check " + frame + " " + cut, "cut.ply");
  ASSERT_EQ(std::system(("gzip -kf " + frame).c_str()), 0);
  const std::string packed = read_text(frame + ".gz");
  const auto cut_gz = scratch.write("cut.ply.gz", packed.substr(0, packed.size() / 2));
  expect_brief_refusal("check " + frame + " " + cut_gz, "cut.ply.gz");
}

TEST_F(BadInput, MeshesThatDoNotFit) {
  expect_bad_frame("five.obj", std::string(tetrahedron) + "v 9 9 9\n", "vert");
  std::string other = tetrahedron;
  other.replace(other.find("f 1 3 2"), 7, "f 1 2 3");
  expect_bad_frame("other.obj", other, "triangle 0 is (0, 1, 2), but in ");
  expect_bad_frame("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\n", "nan.obj");
  expect_bad_frame("huge.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\n", "huge.obj");
  expect_bad_frame("range.obj", std::string(tetrahedron) + "f 1 2 9\n", "range.obj");
  expect_bad_frame("repeated.obj", std::string(tetrahedron) + "f 1 2 2\n", "repeated.obj");
  const auto twice = scratch.write("twice.obj", std::string(tetrahedron) + "f 3 1 2\n");
  expect_brief_refusal("check " + twice + " " + twice, "same three vertices (lines 5 and 9)");
}

TEST_F(BadInput, QueryFiles) {
  std::string row = "0,1,0,1,0,1\n", seven, letters;
  for (int i = 0; i < 7; ++i) seven += row;
  for (int i = 0; i < 8; ++i) letters += "a,b,c,d,e,f\n";
  expect_brief_refusal("check " + scratch.write("7ee.csv", seven), "7ee.csv");
  expect_brief_refusal("check " + scratch.write("letters_vf.csv", letters), "letters_vf.csv");
  expect_brief_refusal("check " + scratch.write("unnamed.csv", seven + row), "unnamed.csv");
  const auto eight = scratch.write("8ee.csv", seven + row);
  const auto truths = scratch.write("truth.json", "[true,false]");
  expect_brief_refusal("check " + eight + " --truth " + truths, "truth.json");
  expect_brief_refusal("check " + eight + " --truth " + truths + " " + truths, "2 truth files");
  expect_brief_refusal("check " + eight + " --method guess", "guess");
}

TEST_F(BadInput, CaseFiles) {
  expect_brief_refusal("check " + scratch.write("other.json", "{\"schema\": \"assay-case/2\"}"),
                       "assay-case");
  std::string text =
      read_text(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/A4_endpoints_only.json");
  const std::string known = "\"culling\": \"view-point\"";
  ASSERT_NE(text.find(known), std::string::npos);
  text.replace(text.find(known), known.size(), "\"culling\": \"fast\"");
  expect_brief_refusal("check " + scratch.write("option.json", text), "fast");
  expect_brief_refusal("check " + scratch.write("broken.json", "{\"schema\": "), "broken.json");
}

TEST_F(BadInput, Options) {
  expect_brief_refusal("", "name a verb");
  expect_brief_refusal("frobnicate", "frobnicate");
  expect_brief_refusal("check " + good + " " + good + " --culling fast",
                       "view-auto, view-point, view-line, normal-cone, bvh, none");
  expect_brief_refusal("check " + good + " " + good + " --start maybe", "maybe");
  expect_brief_refusal("check " + good + " " + good + " --pairs some", "some");
  expect_brief_refusal("check " + good + " " + good + " --jobs 0", "jobs");
  expect_brief_refusal("check " + good + " " + good + " --time -3", "time");
  expect_brief_refusal("check " + good + " " + good + " --memory lots", "memory");
  expect_brief_refusal("check " + good + " " + good + " --json /nowhere/report.json", "/nowhere");
  expect_brief_refusal("check " + good + " " + good + " --json -", "-: name a file");
  expect_brief_refusal("run --campain smoke --out " + (scratch / "x"),
                       "not expected: --campain smoke; did you mean --campaign? (assay run --help");
  expect_brief_refusal("chekc " + good, "unknown verb 'chekc'; did you mean check?");
  expect_brief_refusal("run --campaign smok --out " + (scratch / "x"),
                       "smok: is no campaign and no file; did you mean smoke?");
  for (const std::string size : {"-1", "0", "GB", "1.5GB", "99999999999999999999", "6TB"}) {
    expect_brief_refusal("check " + good + " " + good + " --memory " + size, "memory");
  }
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
  expect_brief_refusal("list errors", "errors");
}

}  // namespace
}  // namespace assay::tests
