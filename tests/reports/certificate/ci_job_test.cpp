// The job of detector/plugin/README.md, "In your CI", as a machine runs it:
// tests/plugins/ci_job.sh.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;

class CiJob : public testing::Test {
 protected:
  // A checkout of Assay, built, and one of a detector.
  CiJob() {
    const fs::path built = scratch / "assay/build/release";
    fs::create_directories(built);
    fs::create_symlink(ASSAY_PROGRAM, built / "assay");
    fs::create_symlink(ASSAY_WORKER, built / "assay-worker");
    fs::create_symlink(source / "detector", scratch / "assay/detector");
    fs::create_directories(scratch / "mine/cases");
    fs::copy_file(curated("D6_fast_passage"), scratch / "mine/cases/fast.json");
    scratch.write("few.json",
                  R"({"schema": "assay-campaign/1", "name": "few", "seconds": null, "strata": [)"
                  R"({"family": "closed-generic", "cases": 6}, {"family": "broken", "cases": 6}, )"
                  R"({"family": "unclosed-generic", "cases": 6}],)"
                  R"("fault_cases": 20, "fault_seeds": 1, "policy": {"self_test_queries": 20}})");
  }

  // Its exit code. What it prints is in `printed`.
  int run(const std::string& seed) {
    const std::string log = scratch / "log";
    const std::string line = "cd " + (scratch / "mine") + " && ASSAY=" + (scratch / "assay") +
                             " CAMPAIGN=" + (scratch / "few.json") + " SEED=" + seed + " sh " +
                             (source / "tests/plugins/ci_job.sh").string() + " >" + log + " 2>&1";
    const int status = std::system(line.c_str());
    printed = read_text(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string report(const std::string& name) const {
    return read_text(scratch / "mine/reports/" + name);
  }
  const fs::path source = ASSAY_SOURCE_DIR;
  const Scratch scratch;
  std::string printed;
};

TEST_F(CiJob, IsOfTenLinesAndStandsOnThePage) {
  const auto job = read_text((source / "tests/plugins/ci_job.sh").string());
  EXPECT_EQ(std::count(job.begin(), job.end(), '\n'), 10);
  EXPECT_TRUE(
      says(read_text((source / "detector/plugin/README.md").string()), "```sh\n" + job + "```\n"));
}

TEST_F(CiJob, EndsWithTheVerdict) {
  scratch.write("mine/detector.cpp", "this is no C++");
  EXPECT_EQ(run("1"), 2) << printed;

  fs::copy_file(source / "tests/plugins/example_in_cpp.cpp", scratch / "mine/detector.cpp",
                fs::copy_options::overwrite_existing);
  scratch.write("mine/cases/known.json",
                R"({"schema": "assay-known/1", "waivers": [{"signature": "free-sound: mine",)"
                R"("reason": "r", "link": "l", "expires": "9999-12-31"}]})");
  EXPECT_EQ(run("2"), 0) << printed;
  EXPECT_TRUE(contains(printed, "\nown cases ")) << printed;
  EXPECT_TRUE(
      contains(printed, " by their curated case alone; campaign few, seed 1, of this build\n"));
  EXPECT_TRUE(contains(printed, "\nverdict: certified in ")) << printed;
  EXPECT_TRUE(contains(report("junit.xml"), "own cases"));
  EXPECT_TRUE(contains(report("summary.md"), "certified"));
  const auto certificate = read_text(scratch / "mine/certified-2/certificate.json");
  EXPECT_TRUE(contains(certificate, "\"free-sound: mine\""));
  EXPECT_TRUE(contains(certificate, " --corpus " + (scratch / "mine/cases")));
}

}  // namespace
}  // namespace assay::tests
