// A plug-in that answers nothing and tries everything: no reply of its is a run that holds, and
// what is not its own stays as it is.
#include <grp.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "properties/worker/isolation/scratch_folder.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/worker/worker_cases.h"

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
  bool sleeps() const {
    std::ifstream status("/proc/" + std::to_string(id_) + "/stat");
    std::string text(std::istreambuf_iterator<char>(status), {});
    return text.find(") S ") != std::string::npos;
  }

 private:
  pid_t id_;
};

// All that a deed could harm, as the plug-in finds it in its variables.
class Hostile : public testing::Test {
 protected:
  Hostile() {
    std::string name = (std::filesystem::temp_directory_path() / "assay-victim-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(victim()) << words;
    setenv("ASSAY_VICTIM", victim().c_str(), 1);
    setenv("ASSAY_BYSTANDER", std::to_string(bystander_.id()).c_str(), 1);
  }
  ~Hostile() override { std::filesystem::remove_all(folder_); }

  std::string victim() const { return (folder_ / "victim").string(); }

  const std::filesystem::path& folder() const { return folder_; }

  static constexpr std::uint64_t two_gigabytes = std::uint64_t{1} << 31;
  CaseRun run(const std::string& mode, const WorkerLimits& limits = {.2, two_gigabytes}) {
    setenv("ASSAY_HOSTILE", mode.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), limits);
    return worker.run(small_case(31, 0), plugin_alone)[0];
  }

  void expect_all_is_well(const std::string& mode) {
    std::ifstream file(victim());
    const std::string now(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(now, words) << mode;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << mode;
    EXPECT_TRUE(bystander_.sleeps()) << mode;
  }

 private:
  static constexpr const char* words = "not the plug-in's";
  Bystander bystander_;
  std::filesystem::path folder_;
};

TEST_F(Hostile, ForgedRepliesAreCrashes) {
  for (const auto& [rule, modes] : std::map<std::string, const char*>{
           {"0 results for 1 steps", "forge-no-steps"},
           {"9 results for 1 steps", "forge-more-steps"},
           {"that it not run, which only the host can say", "forge-not-run"},
           {"that it hung, which only the host can say", "forge-hung"},
           {"that it crashed, which only the host can say", "forge-crashed"},
           {"steps of a case that was not run", "forge-refused-with-steps"},
           {"bytes that are none",
            "forge-end forge-answer forge-bool forge-count-of-steps forge-garbage forge-nothing"},
           {"to another request", "forge-number forge-place"},
           {"a text that is no line", "forge-text forge-control forge-bytes"},
           {"longer than any reply to this case", "forge-long-text"},
           {"a first time that is no interval in [0, 1]", "forge-no-interval"},
           {"a pair that is none of the mesh",
            "forge-pair-beyond forge-pair-of-one forge-pair-time"},
           {"pairs that do not ascend", "forge-pair-twice"},
           {"pairs beside the answer free", "forge-free-with-pairs"},
           {"views, which no plug-in has", "forge-views"},
           {"counts or times, which the host measures", "forge-counts"},
           {"candidates that it does not claim", "forge-candidates"},
           {"answers of another kind of detector", "forge-no-answers"},
           {"0 lists of candidates for 1 steps", "forge-candidate-none"},
           {"no candidates beside an answer", "forge-candidate-missing"},
           {"a candidate that is none of the mesh",
            "forge-candidate-beyond forge-candidate-of-one forge-candidate-negative"},
           {"candidates that do not ascend", "forge-candidate-twice"},
           {"0 limits for 1 steps", "forge-limit-none"},
           {"no limit beside an answer", "forge-limit-missing"},
           {"a share that is none",
            "forge-limit-share forge-limit-no-share forge-limit-not-a-number"},
           {"positions that are none of the mesh", "forge-limit-short forge-limit-infinite"},
       }) {
    for (const auto& mode : tests::words(modes)) {
      const auto run = this->run(mode);
      EXPECT_EQ(run.end, RunEnd::crashed) << mode;
      EXPECT_EQ(run.explanation, "sent a reply that is none: " + rule) << mode;
      EXPECT_TRUE(run.steps.empty()) << mode;
    }
  }
}

TEST_F(Hostile, ForgedAnswersToQueriesAreCrashesOfTheseQueries) {
  const auto query = case_of_query({}, "query");
  for (const auto& [mode, rule] : std::map<std::string, std::string>{
           {"forge-query-count", "2 results for 1 steps"},
           {"forge-query-none", "0 results for 1 steps"},
           {"forge-query-nan", "a first time that is no interval in [0, 1]"},
           {"forge-query-time", "a first time that is no interval in [0, 1]"},
           {"forge-query-answer", "bytes that are none"},
           {"forge-query-text", "a text that is no line"},
           {"forge-query-long", "longer than any reply to this case"},
           {"forge-query-number", "to another request"},
           {"forge-query-pairs", "a pair that is none of the mesh"},
           {"forge-query-candidates", "candidates that it does not claim"},
       }) {
    setenv("ASSAY_HOSTILE", mode.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), {.seconds = .2});
    for (int repetition = 0; repetition < 3; ++repetition) {
      const auto run = worker.run(query, plugin_alone).front();
      EXPECT_EQ(run.end, RunEnd::crashed) << mode;
      EXPECT_EQ(run.explanation, "sent a reply that is none: " + rule) << mode;
      EXPECT_TRUE(run.steps.empty()) << mode;
    }
  }
  setenv("ASSAY_HOSTILE", "forge-query-lies", 1);
  WorkerProcess liar(ASSAY_WORKER, plugin("hostile"), {.seconds = .2});
  for (int repetition = 0; repetition < 3; ++repetition) {
    const auto run = liar.run(query, plugin_alone).front();
    EXPECT_EQ(run.end, RunEnd::completed) << run.explanation;
    EXPECT_EQ(run.steps.at(0).answer, detector::Answer::free);
  }
}

TEST_F(Hostile, ForgedDescriptionsAreNamed) {
  for (const auto& [mode, rule] : std::map<std::string, std::string>{
           {"forge-name", "a name that is no line"},
           {"forge-refusal", "a refusal that is no line"},
           {"forge-long-refusal", "a refusal that is no line"},
           {"forge-built-in", "the name of the built-in detector"},
           {"forge-built-in-1", "the name of the built-in detector"},
           {"forge-turned-name", "a name or version with characters that nobody sees"},
           {"forge-space", "a name or version that begins or ends with a space"},
           {"forge-long-name", "a name or version of 101 characters, and 100 are the most"},
           {"forge-margin", "its margin is no length"},
           {"forge-length", "no description"}}) {
    setenv("ASSAY_HOSTILE", mode.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), {.seconds = .2});
    const auto described = worker.describe();
    ASSERT_FALSE(described) << mode;
    EXPECT_TRUE(says(described.error(), rule)) << mode;
  }
}

TEST_F(Hostile, WhatIsLegalIsAnAnswer) {
  const auto run = this->run("forge-lies");
  EXPECT_EQ(run.end, RunEnd::completed) << run.explanation;
  ASSERT_EQ(run.steps.size(), 1u);
  EXPECT_EQ(run.steps[0].answer, detector::Answer::free);
  const auto with_candidates = this->run("forge-candidate-lies");
  EXPECT_EQ(with_candidates.end, RunEnd::completed) << with_candidates.explanation;
  EXPECT_EQ(with_candidates.candidates.size(), 1u);
}

TEST_F(Hostile, DeedsHarmNothing) {
  for (const auto& mode : tests::words(
           "overwrite truncate unlink rename link make-beside write-own-program daemon kill- "
           "bystander kill-parents stop-bystander queue-bystander trace-bystander write- "
           "bystander memory-of-bystander memory-of-parent descriptors close-descriptors "
           "descriptors-of-parent many-processes socket terminal new-user kill-itself deep- "
           "stack all-memory")) {
    const auto run = this->run(mode);
    EXPECT_NE(run.end, RunEnd::not_run) << mode << ": " << run.explanation;
    expect_all_is_well(mode);
  }
}

// Of the processes of a user who is root the system would count none.
TEST_F(Hostile, ItStartsNoMoreProcessesThanItMay) {
  // Half a thousand processes alone take some machines more than the time that other deeds get.
  for (const char* mode : {"more-processes-than-allowed", "root-again"}) {
    const auto run = this->run(mode, {5, two_gigabytes});
    EXPECT_EQ(run.end, RunEnd::crashed) << mode;
    EXPECT_EQ(run.explanation, "exited with code 3") << mode;
  }
}

// What it could reach of its host: the host's own channel, files that the host has open, and its
// terminal.
TEST_F(Hostile, ItHasNothingOfItsHostButItsChannel) {
  for (const char* mode : {"descriptors-beside-the-channel", "session-of-the-host"}) {
    const auto run = this->run(mode);
    EXPECT_EQ(run.end, RunEnd::crashed) << mode;
    EXPECT_EQ(run.explanation, "exited with code 3") << mode;
  }
}

TEST_F(Hostile, ItIsNotLoadedAgainWithLessIsolation) {
  setenv("ASSAY_HOSTILE", "", 1);
  const Isolation whole = {true, true, true};
  WorkerProcess worker(ASSAY_WORKER, plugin("hostile"),
                       {.isolation = IsolationMode::none, .least = whole});
  const auto described = worker.describe();
  ASSERT_FALSE(described);
  EXPECT_TRUE(says(described.error(), "its isolation would be none, and was full"));
  const auto run = worker.run(small_case(31, 0), plugin_alone)[0];
  EXPECT_EQ(run.end, RunEnd::not_run) << run.explanation;
}

// All that a stranger sees of a file but what it holds.
std::string looks_of(const std::string& path) {
  struct stat seen = {};
  stat(path.c_str(), &seen);
  std::string looks;
  for (const auto number : {static_cast<long>(seen.st_mode), static_cast<long>(seen.st_uid),
                            static_cast<long>(seen.st_gid), static_cast<long>(seen.st_mtime)})
    looks += std::to_string(number) + " ";
  std::array<char, 256> names;
  const auto size = listxattr(path.c_str(), names.data(), names.size());
  return looks.append(names.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
}

TEST_F(Hostile, NoCallChangesTheHost) {
  setxattr(victim().c_str(), "user.kept", "x", 1, 0);
  const auto file = looks_of(victim()), folder = looks_of(this->folder());
  const auto run = this->run("change-host");
  EXPECT_EQ(run.explanation, "exited with code 3") << "what was done:\n" << run.printed;
  EXPECT_EQ(looks_of(victim()), file);
  EXPECT_EQ(looks_of(this->folder()), folder);
  expect_all_is_well("change-host");
  // The library of filters kills what comes in by another door of the processor.
  EXPECT_EQ(this->run("foreign-call").explanation, "killed by signal 31 (Bad system call)");
#if defined(__x86_64__)
  const auto older = this->run("older-call").explanation;
  EXPECT_TRUE(older == "killed by signal 31 (Bad system call)" ||
              older == "killed by signal 11 (Segmentation fault)")  // the kernel has no such door
      << older;
#endif
  EXPECT_EQ(looks_of(victim()), file);
}

// The same for a user who is not root. Where this is run by root, as another user.
TEST_F(Hostile, NoCallChangesTheHostOfAnOrdinaryUser) {
  if (geteuid() != 0) GTEST_SKIP() << "this user is an ordinary one, whom the test before is of";
  constexpr uid_t nobody = 65534;
  constexpr int cannot = 77;
  ASSERT_EQ(chown(victim().c_str(), nobody, nobody), 0);
  ASSERT_EQ(chown(folder().c_str(), nobody, nobody), 0);
  const auto file = looks_of(victim());
  const pid_t child = fork();
  if (child == 0) {
    if (setgroups(0, nullptr) != 0 || setresgid(nobody, nobody, nobody) != 0 ||
        setresuid(nobody, nobody, nobody) != 0 || access(ASSAY_WORKER, X_OK) != 0)
      _exit(cannot);
    const auto run = this->run("change-host");
    std::printf("%s\n%s\n", run.explanation.c_str(), run.printed.c_str());
    std::fflush(stdout);
    _exit(run.explanation == "exited with code 3" ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  if (WEXITSTATUS(status) == cannot) GTEST_SKIP() << "another user cannot run the worker";
  EXPECT_EQ(status, 0);
  EXPECT_EQ(looks_of(victim()), file);
  expect_all_is_well("change-host");
}

// One that was killed leaves its folder, which the next process clears. One that lives keeps it.
TEST_F(Hostile, FoldersOfKilledRunsAreCleared) {
  const auto before = std::getenv("TMPDIR") ? std::string(std::getenv("TMPDIR")) : "/tmp";
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
    for (int i = 0; i < 6000 && folders() != count; ++i) usleep(10'000);
    EXPECT_EQ(folders(), count);
  };
  unsetenv("ASSAY_HOSTILE");
  std::vector<pid_t> started;
  constexpr long folders_of_one = 2;  // the copy of the library, and what TMPDIR names
  for (const long count : {1, 2}) {
    started.push_back(start());
    wait_for(count * folders_of_one);
  }
  for (const pid_t id : started) {
    kill(id, SIGKILL);
    waitpid(id, nullptr, 0);
  }
  EXPECT_EQ(folders(), 2 * folders_of_one);
  EXPECT_TRUE(ScratchFolder::make());
  EXPECT_EQ(folders(), 0);
  setenv("TMPDIR", before.c_str(), 1);
}

TEST_F(Hostile, WhatItWritesCountsAsMemory) {
  constexpr std::uint64_t bytes = std::uint64_t{1} << 29;
  for (const char* mode : {"fill-scratch", "fill-shared-memory"})
    EXPECT_EQ(this->run(mode, {10, bytes}).explanation, "exited with code 3") << mode;
}

TEST_F(Hostile, ItReadsNothingInTheFolderOfItsRun) {
  EXPECT_EQ(run("read").explanation, "killed by signal 10 (User defined signal 1)");
  WorkerLimits limits{.seconds = 10};
  limits.unread = folder();
  EXPECT_EQ(run("read", limits).explanation, "exited with code 3");
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
  // Other tests run hostile plug-ins too: those of this process name it.
  const std::string host = std::string(1, '\0') + std::to_string(::getpid()) + '\0';
  const auto processes = [&] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "cmdline");
      std::string line;
      std::getline(file, line);  // one that has ended by now has none
      if (line.find("assay-worker") != std::string::npos && line.find(host) != std::string::npos &&
          line.find("plugin_hostile") != std::string::npos)
        names.insert(entry.path().filename());
    }
    return names;
  };
  for (const char* mode : {"daemon", "many-processes"}) {
    run(mode);
    // The system takes a moment to end some hundred of them.
    for (int i = 0; i < 100 && !processes().empty(); ++i) usleep(50'000);
    EXPECT_TRUE(processes().empty()) << mode;
    expect_all_is_well(mode);
  }
}

TEST_F(Hostile, WhatNeverReturnsHangsAndWhatEndsCrashes) {
  for (const char* call : {"create", "evaluate", "result", "destroy"}) {
    EXPECT_EQ(run(std::string("hang-at-") + call).end, RunEnd::hung) << call;
    EXPECT_EQ(run(std::string("exit-at-") + call).end, RunEnd::crashed) << call;
  }
  for (const char* call : {"load", "describe"}) {
    EXPECT_EQ(run(std::string("hang-at-") + call).end, RunEnd::not_run) << call;
    EXPECT_EQ(run(std::string("exit-at-") + call).end, RunEnd::not_run) << call;
  }
}

TEST_F(Hostile, TheIsolationIsSaid) {
  setenv("ASSAY_HOSTILE", "", 1);
  for (const auto mode : {IsolationMode::none, IsolationMode::best}) {
    WorkerProcess worker(ASSAY_WORKER, plugin("hostile"), {.isolation = mode});
    ASSERT_TRUE(worker.describe());
    std::printf("%s: %s\n", name_of(mode), text_of(worker.isolation()).c_str());
    if (mode == IsolationMode::none) {
      EXPECT_EQ(text_of(worker.isolation()), "none");
    }
  }
  WorkerProcess whole(ASSAY_WORKER, plugin("hostile"), {.isolation = IsolationMode::required});
  const auto described = whole.describe();
  if (described) {
    EXPECT_EQ(text_of(whole.isolation()), "full");
  } else {
    EXPECT_TRUE(says(described.error(), "isolation is required, and this system's is"));
  }
}

}  // namespace
}  // namespace assay::properties
