// Runs a hostile plug-in (tests/plugins/hostile.cpp) through the verbs that judge detectors.
#pragma once

#include <signal.h>

#include "properties/worker/isolation.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {

// What the plug-in does, and the exit codes with which a campaign can end: 1 if the plug-in
// answers, crashes or is caught, 2 if it cannot be loaded, 3 if it hangs. The mode many-processes
// has two codes: it hangs if starting hundreds of processes takes too long.
struct HostileMode {
  std::string name;
  std::vector<int> exit_codes;
};

inline std::vector<HostileMode> modes_of(const std::string& names, const std::vector<int>& codes) {
  std::vector<HostileMode> modes;
  for (const auto& name : words(names)) modes.push_back({name, codes});
  return modes;
}

// Returns the modes that end at once.
inline const std::vector<HostileMode>& quick_modes() {
  static const std::vector<HostileMode> modes = [] {
    auto all = modes_of(
        "overwrite truncate unlink rename link make-beside write-own-program daemon "
        "kill-bystander kill-parents stop-bystander descriptors close-descriptors socket terminal "
        "kill-itself deep-stack exit-at-create exit-at-evaluate exit-at-commit exit-at-result "
        "exit-at-destroy",
        {1});
    for (const auto& mode : modes_of("exit-at-load exit-at-describe", {2})) all.push_back(mode);
    all.push_back({"many-processes", {1, 3}});
    return all;
  }();
  return modes;
}

// Returns the modes that hang until a limit ends them.
inline const std::vector<HostileMode>& hanging_modes() {
  static const auto modes = modes_of(
      "spin hang-at-create hang-at-evaluate hang-at-commit hang-at-result hang-at-destroy", {3});
  return modes;
}

class HostilePlugin : public testing::Test {
 protected:
  // Returns whether bubblewrap does not work here. The plug-in then runs under limits alone, and
  // some modes reach this process and files beside it.
  static bool is_let_loose() { return !properties::fault_of_bubblewrap().empty(); }

  // Tells hostile.cpp, by the environment of the program, what to do.
  static void does(const std::string& mode) { setenv("ASSAY_HOSTILE", mode.c_str(), 1); }

  static void SetUpTestSuite() {
    other_ = std::make_unique<Scratch>();
    const auto made = run_assay("run --campaign " + other_->write("plan.json", plan_text(4)) +
                                " --out " + *other_ / "out");
    ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  }
  static void TearDownTestSuite() { other_.reset(); }

  HostilePlugin() : bystander_(fork()), before_(files_of_the_other()) {
    if (bystander_ == 0) {
      for (;;) pause();
    }
    setenv("ASSAY_VICTIM", (*other_ / "out/run.sqlite").c_str(), 1);
    setenv("ASSAY_BYSTANDER", std::to_string(bystander_).c_str(), 1);
  }
  ~HostilePlugin() override {
    kill(bystander_, SIGKILL);
    waitpid(bystander_, nullptr, 0);
  }

  Outcome judge(const std::string& verb, const std::string& mode, const std::string& more = "",
                const std::string& prefix = "") {
    does(mode);
    out = scratch / (verb + "-" + std::to_string(runs_++));
    return run_assay(verb + " --jobs 2 --campaign " + plan + " --detector " + hostile + " --out " +
                         out + " " + more,
                     prefix);
  }

  // Judges the plug-in under a limit, which is an option of prlimit, and returns the exit code.
  // Expects that the code means neither that all holds, nor a crash, nor that the program failed
  // its own check.
  int expect_no_excuse(const std::string& verb, const std::string& mode, const std::string& limit,
                       const std::string& prefix = "") {
    const auto ended = judge(verb, mode, "", prefix + "prlimit " + limit + " ");
    // The system could not start the program.
    if (contains(ended.err, "error while loading shared libraries")) return ended.exit_code;
    EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 2 || ended.exit_code == 3)
        << verb << " " << mode << " " << limit << ": " << ended.exit_code << "\n"
        << ended.out << ended.err;
    if (ended.exit_code == 2) {
      EXPECT_EQ(ended.err.rfind("assay: ", 0), 0u) << limit << ": " << ended.err;
      EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    }
    expect_unharmed(mode);
    return ended.exit_code;
  }

  // Expects that the files of another run, and another process, are as they were.
  void expect_unharmed(const std::string& mode) const {
    EXPECT_EQ(files_of_the_other(), before_) << mode;
    const auto status = read_text("/proc/" + std::to_string(bystander_) + "/stat");
    EXPECT_TRUE(contains(status, ") S ")) << mode << ": " << status;
  }

  // Expects one of the exit codes of the mode, and that no file of the run or the certificate says
  // that the plug-in holds.
  void expect_no_verdict_bought(const std::string& verb, const HostileMode& mode,
                                const Outcome& ended) const {
    const auto is_expected =
        std::count(mode.exit_codes.begin(), mode.exit_codes.end(), ended.exit_code) > 0;
    EXPECT_TRUE(is_expected) << verb << " " << mode.name << ": " << ended.exit_code << "\n"
                             << ended.out << ended.err;
    expect_unharmed(mode.name);
    if (ended.exit_code == 2) {
      expect_refused(ended, "");
      return;
    }
    EXPECT_TRUE(contains(ended.out, "\nisolation: ")) << ended.out;
    const auto summary = read_text(out + "/summary.md");
    EXPECT_TRUE(contains(summary, "isolation ")) << mode.name << "\n" << summary;
    EXPECT_FALSE(contains(summary, "## Assay: certified")) << mode.name;
    EXPECT_FALSE(contains(summary, "## Assay: holds")) << mode.name;
    if (verb != "certify") return;
    const auto certificate = out + "/certificate.json";
    const auto verdict =
        nlohmann::json::parse(read_text(certificate))["predicate"]["verdict"].get<std::string>();
    EXPECT_EQ(verdict, ended.exit_code == 1 ? "defect" : "incomplete") << mode.name;
    EXPECT_EQ(run_assay("verify " + certificate).exit_code, ended.exit_code) << mode.name;
  }

  // Judges the plug-in in each mode by a verb, and expects that nothing holds.
  void expect_none_holds(const std::string& verb, std::vector<HostileMode> modes) {
    for (const auto* more : {&quick_modes(), &hanging_modes()})
      modes.insert(modes.end(), more->begin(), more->end());
    for (const auto& mode : modes) expect_no_verdict_bought(verb, mode, judge(verb, mode.name));
    EXPECT_GE(modes.size(), 25u);
  }

  const Scratch scratch;
  const std::string plan =
      scratch.write("plan.json", R"({"schema": "assay-campaign/1", "name": "tiny",)"
                                 R"( "seconds": 60, "case_seconds": 0.1, "shrink_share": 0.001,)"
                                 R"( "strata": [{"family": "closed-generic", "cases": 3}]})");
  const std::string hostile = plugin("hostile");
  // A prefix for commands. It puts into the PATH a bwrap that is not permitted to run, as in some
  // containers.
  const std::string forbidden_bwrap = [&] {
    namespace fs = std::filesystem;
    const auto file =
        scratch.write("bwrap", "#!/bin/sh\necho 'bwrap: not permitted' >&2\nexit 1\n");
    fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add);
    return "PATH=" + fs::path(file).parent_path().string() + ":$PATH ";
  }();
  std::string out;

 private:
  static std::map<std::string, std::string> files_of_the_other() {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*other_ / "")) {
      if (entry.is_regular_file()) files[entry.path()] = read_text(entry.path());
    }
    return files;
  }

  inline static std::unique_ptr<Scratch> other_;
  const pid_t bystander_;
  const std::map<std::string, std::string> before_;
  int runs_ = 0;
};

}  // namespace assay::tests
