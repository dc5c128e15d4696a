// A plug-in that answers nothing and misbehaves in every possible way: none of its runs holds, and
// it changes nothing outside of its process.
#include "properties/worker/isolation.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/worker/worker_cases.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using test::plugin, test::plugin_alone, test::small_case;

// A process that is not the plug-in's, and sleeps.
class Bystander {
 public:
  Bystander() : id_(fork()) {
    if (id_ != 0) return;
    for (;;) pause();
  }
  ~Bystander() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  pid_t id() const { return id_; }
  bool sleeps() const { return test::stat_of(id_).find(") S ") != std::string::npos; }

 private:
  pid_t id_;
};

// All that a deed could harm, as the plug-in finds it in its variables.
class Hostile : public testing::Test {
 protected:
  Hostile() {
    unsetenv("ASSAY_HOSTILE");
    std::ofstream(victim()) << words;
    setenv("ASSAY_VICTIM", victim().c_str(), 1);
    setenv("ASSAY_BYSTANDER", std::to_string(bystander_.id()).c_str(), 1);
  }

  ~Hostile() override { setenv("TMPDIR", scratch_folders_.c_str(), 1); }

  std::string victim() const { return folder_ / "victim"; }
  std::string folder() const { return folder_ / ""; }

  static constexpr std::uint64_t two_gigabytes = std::uint64_t{1} << 31;
  CaseRun run(const std::string& mode, const WorkerLimits& limits = {.2, two_gigabytes}) {
    setenv("ASSAY_HOSTILE", mode.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), limits);
    return worker.run(small_case(31, 0), plugin_alone)[0];
  }

  void expect_all_is_well(const std::string& mode) {
    EXPECT_EQ(tests::read_text(victim()), words) << mode;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), {}), 1) << mode;
    EXPECT_TRUE(bystander_.sleeps()) << mode;
  }

 private:
  static constexpr const char* words = "not the plug-in's";
  Bystander bystander_;
  const tests::Scratch folder_;
  const std::string scratch_folders_ = std::filesystem::temp_directory_path();
};

TEST_F(Hostile, DeedsHarmNothing) {
  if (!fault_of_bubblewrap().empty()) GTEST_SKIP() << fault_of_bubblewrap();
  for (const auto& mode :
       tests::words("overwrite truncate unlink rename link make-beside write-own-program daemon "
                    "kill-bystander kill-parents stop-bystander descriptors close-descriptors "
                    "many-processes socket terminal kill-itself deep-stack all-memory")) {
    const auto run = this->run(mode);
    EXPECT_NE(run.end, RunEnd::not_run) << mode << ": " << run.explanation;
    expect_all_is_well(mode);
  }
}

// It starts no more processes than it may, where of those of a user who is root the system would
// count none; and has nothing of its host but its channel: neither files that the host has open nor
// its terminal.
TEST_F(Hostile, WhatItIsNotGivenItDoesNotHave) {
  for (const std::string mode :
       {"more-processes-than-allowed", "descriptors-beside-the-channel", "session-of-the-host"}) {
    // Half a thousand processes alone take some machines more than the time that other deeds get.
    const auto run = this->run(mode, {mode.starts_with("more") ? 5 : .2, two_gigabytes});
    EXPECT_EQ(run.end, RunEnd::crashed) << mode;
    EXPECT_EQ(run.explanation, "exited with code 3") << mode;
  }
}

// One that was killed leaves its folder, which the next process clears. One that lives keeps it.
TEST_F(Hostile, FoldersOfKilledRunsAreCleared) {
  setenv("TMPDIR", folder().c_str(), 1);
  const auto folders = [&] {
    return std::distance(std::filesystem::directory_iterator(folder()), {}) - 1;  // the victim
  };
  const auto start = [] {
    const pid_t id = fork();
    if (id != 0) return id;
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"));
    if (!worker.describe()) _exit(1);
    for (;;) pause();
  };
  const auto wait_for = [&](long count) {
    EXPECT_TRUE(test::comes_true([&] { return folders() == count; })) << folders();
  };
  std::vector<pid_t> started;
  for (const long count : {1, 2}) {
    started.push_back(start());
    wait_for(count);
  }
  for (const pid_t id : started) {
    kill(id, SIGKILL);
    waitpid(id, nullptr, 0);
  }
  EXPECT_EQ(folders(), 2);
  // The worker of a killed host ends by itself, and may use its folder until then.
  EXPECT_TRUE(test::comes_true([&] {
    EXPECT_TRUE(ScratchFolder::make());
    return folders() == 0;
  }));
}

// Behind bwrap /dev is another one.
TEST_F(Hostile, AScratchFolderBelowDevLeavesLimitsAlone) {
  if (!std::filesystem::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm";
  setenv("TMPDIR", "/dev/shm", 1);
  WorkerProcess worker(ASSAY_WORKER, plugin("hostile"));
  EXPECT_TRUE(worker.describe());
  EXPECT_EQ(worker.isolation(), Isolation::limits);
  WorkerProcess asked(ASSAY_WORKER, plugin("hostile"), {.isolation = Isolation::bubblewrap});
  const auto refused = asked.describe();
  ASSERT_FALSE(refused);
  EXPECT_TRUE(says(refused.error().message, "/dev/shm is hidden behind bwrap"));
}

TEST_F(Hostile, WhatItWritesCountsAsMemory) {
  if (!fault_of_bubblewrap().empty()) GTEST_SKIP() << fault_of_bubblewrap();
  constexpr std::uint64_t bytes = std::uint64_t{1} << 29;
  for (const char* mode : {"fill-scratch", "fill-shared-memory"})
    EXPECT_EQ(this->run(mode, {10, bytes}).explanation, "exited with code 3") << mode;
}

// Both are asleep, so they end after 10 times the limit, and not after 100 times.
TEST_F(Hostile, WhatStopsItselfOrWaitsForAChildSleeps) {
  for (const char* mode : {"stop-itself", "wait-for-a-child"}) {
    const auto run = this->run(mode, {.seconds = .05});
    EXPECT_EQ(run.end, RunEnd::hung) << mode;
    EXPECT_EQ(run.explanation, "no answer in 0.05 s of processor time: asleep for 0.5 s") << mode;
  }
}

TEST_F(Hostile, NothingThatItStartedOutlivesIt) {
  if (!fault_of_bubblewrap().empty()) GTEST_SKIP() << fault_of_bubblewrap();
  // Other tests run hostile plug-ins too: those of this process name it.
  const auto host = std::to_string(::getpid());
  setenv("ASSAY_HOST_OF_TEST", host.c_str(), 1);
  const auto processes = [&] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "environ");
      // None once it has ended.
      const std::string variables(std::istreambuf_iterator<char>(file), {});
      if (variables.find("ASSAY_HOST_OF_TEST=" + host + '\0') != std::string::npos)
        names.insert(entry.path().filename());
    }
    return names;
  };
  {
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"));
    ASSERT_TRUE(worker.describe());
    EXPECT_FALSE(processes().empty()) << "one that lives is seen";
  }
  for (const char* mode : {"daemon", "many-processes"}) {
    run(mode);
    // The system takes a moment to end some hundred of them.
    EXPECT_TRUE(test::comes_true([&] { return processes().empty(); })) << mode;
    expect_all_is_well(mode);
  }
}

TEST_F(Hostile, WhatNeverReturnsHangsAndWhatEndsCrashes) {
  for (const std::string call : {"load", "describe", "create", "evaluate", "result", "destroy"}) {
    const bool is_before = call == "load" || call == "describe";
    EXPECT_EQ(run("hang-at-" + call).end, is_before ? RunEnd::not_run : RunEnd::hung) << call;
    EXPECT_EQ(run("exit-at-" + call).end, is_before ? RunEnd::not_run : RunEnd::crashed) << call;
  }
}

TEST_F(Hostile, TheIsolationIsSaid) {
  for (const auto& asked : {std::optional<Isolation>(), std::optional(Isolation::limits),
                            std::optional(Isolation::bubblewrap)}) {
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), {.isolation = asked});
    const auto described = worker.describe();
    if (asked == Isolation::bubblewrap && !fault_of_bubblewrap().empty()) {
      ASSERT_FALSE(described);
      EXPECT_TRUE(says(described.error(), "bubblewrap does not work here: "));
      continue;
    }
    ASSERT_TRUE(described) << described.error().message;
    const auto best = fault_of_bubblewrap().empty() ? Isolation::bubblewrap : Isolation::limits;
    EXPECT_EQ(worker.isolation(), asked.value_or(best));
  }
}

// Without bwrap the limits hold all the same, and so does what the host says of each end.
TEST_F(Hostile, LimitsAloneEndItToo) {
  const auto run = [&](const std::string& mode, double seconds = .2) {
    constexpr std::uint64_t bytes = std::uint64_t{1} << 28;
    return this->run(mode, {.seconds = seconds, .bytes = bytes, .isolation = Isolation::limits});
  };
  EXPECT_EQ(run("all-memory", 5).explanation, "exited with code 3");
  EXPECT_EQ(run("deep-stack").explanation, "killed by signal 11 (Segmentation fault)");
  EXPECT_EQ(run("kill-itself").explanation, "killed by signal 9 (Killed), three times in a row");
  EXPECT_EQ(run("spin").explanation, "no answer in 0.2 s of processor time");
  EXPECT_EQ(run("stop-itself", .05).end, RunEnd::hung);
  EXPECT_EQ(run("exit-at-evaluate").explanation, "exited with code 0");
  EXPECT_EQ(run("session-of-the-host").explanation, "exited with code 3");
  EXPECT_EQ(run("descriptors-beside-the-channel").explanation, "exited with code 3");
  expect_all_is_well("limits alone");
}

}  // namespace
}  // namespace assay::properties
