// The files of detector/plugin/ci: the job for a CI machine, and the lines for GitHub and GitLab
// that run it.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* job_file = "detector/plugin/ci/job.sh";

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

  // The exit code of a line in the folder of the detector. What it prints is in `printed`.
  int run_line(const std::string& line) {
    const std::string log = scratch / "log";
    const int code = exit_code_of(
        "cd " + (scratch / "mine") + " && export PATH=" + (scratch / "assay/build/release") +
        ":$PATH CAMPAIGN=" + (scratch / "few.json") + "; (" + line + ") >" + log + " 2>&1");
    printed = read_text(log);
    return code;
  }
  int run(const std::string& seed, const std::string& more = "") {
    return run_line("SEED=" + seed + " " + more + " sh " + (source / job_file).string());
  }
  void copy_example() const {
    fs::copy_file(source / "tests/plugins/example_in_cpp.cpp", scratch / "mine/detector.cpp",
                  fs::copy_options::overwrite_existing);
  }
  std::string report(const std::string& name) const {
    return read_text(scratch / "mine/reports/" + name);
  }
  const fs::path source = ASSAY_SOURCE_DIR;
  const Scratch scratch;
  std::string printed;
};

TEST_F(CiJob, EndsWithTheVerdict) {
  scratch.write("mine/detector.cpp", "this is no C++");
  EXPECT_EQ(run("1"), 2) << printed;

  copy_example();
  EXPECT_EQ(run("2"), 0) << printed;
  expect_says(printed, {"\nown cases ",
                        " by their curated case alone; campaign few, seed 1, of this build\n",
                        "\nverdict: certified in "});
  EXPECT_TRUE(contains(report("junit.xml"), "name=\"corpus\"/>"));
  EXPECT_TRUE(contains(report("summary.md"), "certified"));
  const auto certificate = read_text(scratch / "mine/certified-2/certificate.json");
  EXPECT_TRUE(contains(certificate, " --corpus ../cases "));
}

TEST_F(CiJob, TakesOwnSourcesAndFlagsAndNeedsNoCases) {
  fs::remove_all(scratch / "mine/cases");
  copy_example();
  scratch.write("mine/other.cpp", "#if MINE != 1\n#error not told\n#endif\n");
  EXPECT_EQ(run("1", "SOURCES='detector.cpp other.cpp'"), 2) << printed;
  EXPECT_FALSE(contains(printed, "cp: ")) << printed;
  EXPECT_EQ(run("1", "SOURCES='detector.cpp other.cpp' CXXFLAGS='-DMINE=1 -g0' LDLIBS=-lm"), 0)
      << printed;
  // The proof is there already, and an empty folder is no case either.
  fs::create_directories(scratch / "mine/cases");
  EXPECT_EQ(run("2"), 0) << printed;
  EXPECT_TRUE(contains(printed, "this folder has no case yet")) << printed;
}

TEST_F(CiJob, CompilesNothingWhereTheDetectorIsThere) {
  EXPECT_EQ(run("2", "DETECTOR=" + plugin("example_in_cpp")), 0) << printed;
  EXPECT_FALSE(fs::exists(scratch / "mine/libmine.so"));
  // Another campaign has a proof of its own, which is made before the detector is looked for.
  const std::string other = scratch / "other.json";
  fs::copy_file(scratch / "few.json", other);
  EXPECT_EQ(run("3", "DETECTOR=./none.so CAMPAIGN=" + other), 2) << printed;
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "mine/proof"), {}), 2);
  EXPECT_EQ(run_line("PATH=/usr/bin:/bin sh " + (source / job_file).string()), 2);
  EXPECT_EQ(printed, "the program assay is not found: is it in PATH?\n");
}

// The lines of a file for a CI service that begin with one of these words, as a shell gets them.
std::vector<std::string> shell_lines(const fs::path& file, const std::string& script) {
  std::istringstream lines(read_text(file.string()));
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);) {
    if (!line.ends_with("/" + script)) continue;
    line.erase(0, line.find_first_not_of(" -"));
    if (line.starts_with("run: ")) line.erase(0, 5);
    found.push_back(line);
  }
  return found;
}

TEST_F(CiJob, IsRunByTheFilesForGitHubAndGitLab) {
  fs::create_directory_symlink(scratch / "assay", scratch / "mine/.assay");
  copy_example();
  fs::create_directories(scratch / "bin");
  fs::create_directories(scratch / "assay/reports/package");
  const std::string apt = scratch / "bin/apt-get";
  scratch.write("bin/apt-get", "#!/bin/sh\necho apt-get \"$@\"\n");
  scratch.write("assay/reports/package/pack",
                "#!/bin/sh\necho built; mkdir -p .package; touch .package/assay_1_amd64.deb\n");
  for (const std::string& file : {apt, scratch / "assay/reports/package/pack"})
    fs::permissions(file, fs::perms::owner_all);
  std::string ran;
  for (const char* service : {"github.yml", "gitlab.yml"}) {
    const auto file = source / "detector/plugin/ci" / service;
    const auto install = shell_lines(file, "install.sh"), job = shell_lines(file, "job.sh");
    ASSERT_EQ(install.size(), 1u) << service;
    ASSERT_EQ(job.size(), 1u) << service;
    fs::remove_all(scratch / "mine/.package");
    for (const bool is_cached : {false, true}) {
      EXPECT_EQ(run_line("PATH=" + (scratch / "bin") + ":$PATH; " + install[0]), 0) << printed;
      EXPECT_EQ(contains(printed, "built\n"), !is_cached) << printed;
      EXPECT_TRUE(contains(printed, "g++ ./.package/assay_1_amd64.deb\n")) << printed;
    }
    // The files draw a long seed; here it is one of which few cases are known to be enough.
    const auto words = job[0].find("sh .assay/");
    ASSERT_NE(words, std::string::npos) << job[0];
    EXPECT_TRUE(says(job[0].substr(0, words), "SEED=$(od -An -N6 -tu8 /dev/urandom")) << job[0];
    const auto line = "SEED=2 " + job[0].substr(words);
    if (line == ran) continue;  // what two of them say ends alike
    EXPECT_EQ(run_line(ran = line), 0) << service << ": " << printed;
    EXPECT_TRUE(contains(report("summary.md"), "certified"));
  }
}

}  // namespace
}  // namespace assay::tests
