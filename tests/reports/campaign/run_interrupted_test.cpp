// `assay run` that is killed, interrupted, or started twice: stored results stay, and the same
// command continues the run. A named campaign runs to its end, unless its user sets a limit of
// time.
#include "properties/random.h"
#include "tests/reports/campaign/started.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Interrupted : public testing::Test {
 protected:
  const Scratch scratch;
  std::vector<std::string> words(const std::string& out_folder) const {
    std::vector<std::string> list = {"run", "--campaign", plan, "--out", out_folder};
    if (!library.empty()) list.insert(list.end(), {"--detector", library});
    return list;
  }
  Outcome run(const std::string& out_folder) const {
    std::string line;
    for (const auto& word : words(out_folder)) line += word + " ";
    return run_assay(line);
  }
  // Waits until the run has stored something, or fails.
  void wait_for_trials(const std::string& out_folder, std::size_t least) const {
    for (int i = 0; i < 3000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const auto store = properties::Store::read(out_folder + "/run.sqlite");
      if (store && store.value().trial_count() >= least) return;
    }
    FAIL() << "nothing was stored";
  }
  // How many meshes of each signature are kept: which ones depends on which threads were first.
  static properties::Counts failures_of(const std::string& out_folder) {
    const auto store = value_of(properties::Store::read(out_folder + "/run.sqlite"));
    properties::Counts kept;
    for (const auto& failure : store.failures()) {
      ++kept[failure.signature()];
      EXPECT_FALSE(failure.mesh.empty());
    }
    return kept;
  }
  std::string plan = scratch.write("plan.json", plan_text(400, R"(, "shrink_share": 0.003)"));
  std::string out = scratch / "out", undisturbed = scratch / "undisturbed", library;
  std::string text = scratch / "text";
};

// ASSAY_KILLS=50 for the long form. A run that comes to its end before it is killed is compared,
// and another is begun in an empty folder: all kills hit a run at work.
TEST_F(Interrupted, KilledAtRandomMomentsNothingReportedIsLost) {
  const char* asked = std::getenv("ASSAY_KILLS");
  const int kills = asked ? std::atoi(asked) : 6;
  const char* seed = std::getenv("ASSAY_SEED");
  SCOPED_TRACE(seed ? seed : "seed 1");
  properties::Random random(seed ? std::strtoull(seed, nullptr, 10) : 1, 0);
  library = plugin("always_free");
  plan = scratch.write("plan.json", plan_text(360, R"(, "shrink_share": 0.003)"));
  const auto begin = std::chrono::steady_clock::now();
  const auto reference = run(undisturbed);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  ASSERT_EQ(reference.exit_code, 1) << reference.out << reference.err;
  const auto expected = trials_of(undisturbed);
  const auto expect_all = [&] {
    EXPECT_EQ(trials_of(out), expected);
    EXPECT_EQ(signatures_of(out), signatures_of(undisturbed));
    EXPECT_EQ(failures_of(out), failures_of(undisturbed));
  };
  std::vector<std::string> reported;
  int killed = 0, ended = 0;
  while (killed < kills) {
    ASSERT_LT(ended, 20 * kills) << "hardly ever at work when killed";
    Started started(words(out), text);
    constexpr double longest_share = 0.3;
    std::this_thread::sleep_for(longest_share * random.unit() * whole);
    started.send(SIGKILL);
    const int status = started.end();
    if (!WIFSIGNALED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 1) << read_text(text);
      expect_all();
      std::filesystem::remove_all(out);
      reported.clear();
      ++ended;
      continue;
    }
    ++killed;
    // A run killed before its store was bound has reported nothing.
    if (!std::filesystem::exists(out + "/run.sqlite")) continue;
    if (!properties::Store::read(out + "/run.sqlite")) continue;
    const auto now = trials_of(out);
    EXPECT_TRUE(std::includes(now.begin(), now.end(), reported.begin(), reported.end())) << killed;
    reported = now;
  }
  expect_ended(run(out), 1);
  expect_all();
}

TEST_F(Interrupted, CtrlCEndsItWithALineAndIsNoCrash) {
  plan = scratch.write("plan.json", plan_text(4000));
  for (const int signal : {SIGINT, SIGTERM}) {
    // New ones: the second run starts with those of the first.
    const std::size_t before = std::filesystem::exists(out) ? trials_of(out).size() : 0;
    Started started(words(out), text);
    wait_for_trials(out, before + 20);
    started.send(signal);
    const int status = started.end();
    ASSERT_TRUE(WIFEXITED(status)) << read_text(text);
    EXPECT_EQ(WEXITSTATUS(status), 3) << read_text(text);
    EXPECT_TRUE(says(read_text(text), "interrupted: all judged trials are stored in " + out +
                                          "; run the same command again to go on\n"));
  }
  const auto trials = trials_of(out);
  EXPECT_GE(trials.size(), 20u);
  EXPECT_LT(trials.size(), 8000u);
  for (const auto& line : trials) EXPECT_TRUE(contains(line, R"("outcomes":"HHHHHHHHHH")")) << line;
  EXPECT_TRUE(signatures_of(out).empty());
}

TEST_F(Interrupted, ASecondRunInTheSameFolderIsRefused) {
  plan = scratch.write("plan.json", plan_text(4000));
  Started started(words(out), text);
  wait_for_trials(out, 1);
  expect_refused(run(out), "another process writes this file");
  EXPECT_EQ(run_assay("list failures " + out).out, "no failures\n");
  started.send(SIGKILL);
  started.end();
  // The dead one does not lock.
  expect_ended("run --campaign " + plan + " --time 0.5 --out " + out, 3);
}

TEST_F(Interrupted, ShrinkingLeavesTheBestSoFar) {
  library = plugin("always_free");
  plan = scratch.write("plan.json", plan_text(24, R"(, "shrink_share": 0)"));
  const auto lines = replay_lines(expect_ended(run(out), 1).out);
  ASSERT_FALSE(lines.empty());
  const std::string file = lines[0].substr(7, lines[0].find(' ', 7) - 7);
  ASSERT_TRUE(contains(file, "-original.json")) << lines[0];
  const std::string small = scratch / "small.json";
  for (const int signal : {SIGINT, SIGKILL}) {
    std::filesystem::remove(small);
    Started started({"shrink", file, "--out", small, "--detector", library}, text);
    for (int i = 0; i < 3000 && !std::filesystem::exists(small); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    started.send(signal);
    const int status = started.end();
    EXPECT_EQ(run_assay("replay " + small + " --detector " + library).exit_code, 1);
    // It may have been done already.
    const bool is_told = signal == SIGINT && WIFEXITED(status) && WEXITSTATUS(status) == 3;
    EXPECT_TRUE(
        says(read_text(text), is_told ? "interrupted: smallest case so far: " + small : ""));
  }
}

// What `assay run` says it will do. It does not come to do it.
std::string announced(const std::vector<std::string>& options) {
  const Scratch scratch;
  std::vector<std::string> words = {"run", "--jobs", "1", "--out", scratch / "out"};
  words.insert(words.end(), options.begin(), options.end());
  const Started started(words, scratch / "text");
  std::string text;
  for (int i = 0; i < 3000 && !contains(text, "\nwrites "); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    text = read_text(scratch / "text");
  }
  return text;
}

TEST(RunTimeLimit, SmokeAndQuickHaveNoneButTheUsers) {
  const std::regex until_done("; 1 jobs; until done\n");
  const std::regex until_then("; 1 jobs; until [0-2][0-9]:[0-5][0-9]:[0-5][0-9] at the latest\n");
  for (const std::string name : {"smoke", "quick"}) {
    const auto without = announced({"--campaign", name});
    EXPECT_TRUE(contains(without, "campaign " + name + ", seed 1: ")) << without;
    EXPECT_TRUE(std::regex_search(without, until_done)) << without;
    const auto with = announced({"--campaign", name, "--time", "60"});
    EXPECT_TRUE(std::regex_search(with, until_then)) << with;
  }
  // Longer than a clock counts: no limit, and above all not over at once.
  EXPECT_TRUE(std::regex_search(announced({"--campaign", "smoke", "--time", "1e11"}), until_done));
  const auto nightly = announced({"--campaign", "nightly"});
  EXPECT_TRUE(std::regex_search(nightly, until_then)) << nightly;
}

TEST(RunTimeLimit, MoreThanAClockCountsIsNoLimit) {
  const Scratch scratch;
  const auto plan = scratch.write("plan.json", plan_text(4, R"(, "tetrahedron_seconds": 1e-3)"));
  for (const std::string seconds : {"1e11", "1e300"})
    expect_ended("run --campaign " + plan + " --time " + seconds + " --out " + scratch / seconds,
                 0);
}

}  // namespace
}  // namespace assay::tests
