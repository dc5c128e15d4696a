// What `assay replay --export` writes compiles against the detector alone, and passes.
#include <gtest/gtest.h>

#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

int status_of(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class ExportedCase : public testing::Test {
 protected:
  // Exports the case, compiles its test and runs it: what it prints, or nothing.
  void expect_passes(const std::string& id_or_file) const {
    SCOPED_TRACE(id_or_file);
    const auto exported = run_assay("replay " + id_or_file + " --export " + (scratch / "case"));
    ASSERT_EQ(exported.exit_code, 0) << exported.out << exported.err;
    ASSERT_EQ(compile(), 0) << read_text(scratch / "compiler");
    EXPECT_EQ(status_of((scratch / "test >") + (scratch / "printed")), 0)
        << read_text(scratch / "printed");
    EXPECT_NE(read_text(scratch / "printed").find("1 test from"), std::string::npos);
  }
  int compile() const {
    return status_of(std::string(ASSAY_COMPILER) +
                     " -std=c++20 -Wall -Werror -I " ASSAY_SOURCE_DIR " -isystem " ASSAY_EIGEN " " +
                     (scratch / "case/case_test.cpp") +
                     " " ASSAY_DETECTOR " " ASSAY_DETECTOR_LINKS
                     " -lgtest_main -lgtest "
                     "-pthread -o " +
                     (scratch / "test") + " >" + (scratch / "compiler") + " 2>&1");
  }
  const Scratch scratch;
};

TEST_F(ExportedCase, CompilesAndPasses) {
  expect_passes("tiny:1:unclosed-generic:3");
  // With a line as its view, given, and several steps.
  expect_passes(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/B1_one_vertex_own_nearest.json");
}

TEST_F(ExportedCase, FailsWhereTheDetectorDiffers) {
  const std::string file = std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/A4_endpoints_only.json";
  expect_passes(file);
  // The same test asked of another answer.
  std::string text = read_text(scratch / "case/case_test.cpp");
  const std::string free = "Answer::free", collision = "Answer::collision";
  const bool is_free = text.find(free) != std::string::npos;
  const std::string& stated = is_free ? free : collision;
  ASSERT_NE(text.find(stated), std::string::npos);
  text.replace(text.find(stated), stated.size(), is_free ? collision : free);
  scratch.write("case/case_test.cpp", text);
  ASSERT_EQ(compile(), 0) << read_text(scratch / "compiler");
  EXPECT_EQ(status_of(scratch / "test >/dev/null"), 1);
}

// Of a plug-in: arrays that compile with nothing beside them, a function to fill in, and the same
// arrays through the library.
TEST_F(ExportedCase, OfAPlugInIsPlainArrays) {
  const std::string library = plugin("by_contract");
  const auto exported = run_assay(
      "replay slow:1:closed-generic:19 --detector " + library + " --export " + (scratch / "case"),
      "ASSAY_BY_CONTRACT=miss-inside ");
  ASSERT_EQ(exported.exit_code, 1) << exported.out << exported.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "case/case_test.cpp"));
  const std::string compiler = std::string(ASSAY_COMPILER) + " -std=c++17 -Wall -Wextra -Werror ";
  const auto compiles = [&](const std::string& file, const std::string& more) {
    EXPECT_EQ(status_of(compiler + (scratch / ("case/" + file)) + more + " -o " +
                        (scratch / "program") + " >" + (scratch / "compiler") + " 2>&1"),
              0)
        << read_text(scratch / "compiler");
  };
  compiles("case.cpp", "");
  EXPECT_EQ(status_of(scratch / "program >/dev/null"), 2);
  std::string text = read_text(scratch / "case/case.cpp");
  const std::string unfilled = "return {false, false, 0};";
  ASSERT_NE(text.find(unfilled), std::string::npos);
  text.replace(text.find(unfilled), unfilled.size(), "return {true, false, 0};");
  scratch.write("case/filled.cpp", text);
  compiles("filled.cpp", "");
  EXPECT_EQ(status_of((scratch / "program >") + (scratch / "printed")), 1);
  EXPECT_TRUE(contains(read_text(scratch / "printed"), "answered free at 0, exact collision at "));
  compiles("case_plugin.cpp", " -I " ASSAY_SOURCE_DIR " -ldl");
  const auto judged = [&](const std::string& words) {
    return status_of("ASSAY_BY_CONTRACT=" + words + " " + (scratch / "program ") + library +
                     " >/dev/null");
  };
  EXPECT_EQ(judged("claims=255"), 0);
  EXPECT_EQ(judged("miss-inside"), 1);
  EXPECT_EQ(judged("late=0.1"), 1);
  EXPECT_EQ(status_of(scratch / "program ./none.so >/dev/null"), 2);
}

}  // namespace
}  // namespace assay::tests
