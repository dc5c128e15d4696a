// The worker distinguishes disturbances from faults of the detector: workers are killed from
// outside, and plug-ins end their process.
#include <sys/resource.h>

#include "properties/judging/exam.h"
#include "properties/worker/child_process.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/small_case.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using detector::MovingPoint, test::burning_case, test::children, test::plugin, test::plugin_alone,
    test::small_case;

// The first small case that is, or is not, one on which troubled_builtin.cpp kills itself.
corpus::Case fatal_case(bool is_fatal = true) {
  for (std::uint64_t i = 0;; ++i) {
    auto c = small_case(31, i);
    if ((c.triangles.rows() % 5 == 0) == is_fatal) return c;
  }
}

// Kills the worker, `times` times, when its plug-in has used so much processor time: then a case is
// under way that takes more.
std::thread neighbour(int signal, int times, double seconds) {
  return std::thread([=] {
    int last = 0;
    for (int killed = 0; killed < times;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const auto found = children();
      if (found.empty() || found[0] == last) continue;
      if (look_at(found[0]).descendant_seconds < seconds) continue;
      last = found[0];
      kill(last, signal);
      ++killed;
    }
  });
}

TEST(DisturbedWorker, ARunIsRepeatedAndIsAsIfNothingHadBeen) {
  const auto c = burning_case(.6);
  WorkerProcess undisturbed(ASSAY_WORKER, plugin("burns_time"));
  const auto expected = undisturbed.run(c, plugin_alone)[0];
  ASSERT_EQ(expected.end, RunEnd::completed) << expected.explanation;
  EXPECT_EQ(expected.disturbances, 0u);
  EXPECT_EQ(undisturbed.disturbances(), 0u);
  { const WorkerProcess ended = std::move(undisturbed); }
  std::uint64_t times = 1;
  for (const int signal : {SIGKILL, SIGTERM}) {
    WorkerProcess worker(ASSAY_WORKER, plugin("burns_time"));
    auto killer = neighbour(signal, static_cast<int>(times), .2);
    const auto runs = worker.run(c, plugin_alone);
    killer.join();
    EXPECT_EQ(runs[0].end, RunEnd::completed) << runs[0].explanation;
    EXPECT_TRUE(same_answers(runs[0], expected));
    EXPECT_EQ(runs[0].disturbances, times);
    EXPECT_EQ(worker.disturbances(), times);
    EXPECT_EQ(worker.starts(), times + 1);
    EXPECT_GE(runs[0].processor_seconds, .6);
    ++times;
  }
}

TEST(DisturbedWorker, ThreeTimesInARowIsTheDetectorsDoing) {
  const std::map<std::string, std::string> ends = {
      {"kills_itself", "killed by signal 9 (Killed), three times in a row"},
      {"terminates_itself", "killed by signal 15 (Terminated), three times in a row"}};
  const auto fatal = fatal_case(), harmless = fatal_case(false);
  for (const auto& [name, explanation] : ends) {
    WorkerProcess worker(ASSAY_WORKER, plugin(name));
    const auto run = worker.run(fatal, plugin_alone)[0];
    EXPECT_EQ(run.end, RunEnd::crashed);
    EXPECT_EQ(run.explanation, explanation);
    EXPECT_EQ(run.disturbances, 0u);
    EXPECT_EQ(worker.starts(), 3u);
    const auto verdict = judge_run(fatal, run, {}, {Claim::total}, {});
    EXPECT_EQ(verdict.breaches, std::vector<Claim>{Claim::total});
    EXPECT_EQ(verdict.explanation, explanation);
    EXPECT_TRUE(same_answers(worker.run(fatal, plugin_alone)[0], run));
    // The next case begins to count anew.
    EXPECT_EQ(worker.run(harmless, plugin_alone)[0].end, RunEnd::completed);
    EXPECT_EQ(worker.disturbances(), 0u);
    EXPECT_EQ(worker.starts(), 7u);
  }
}

// Small cases that go to the worker together: query i has its first contact at (i + 1) / 1024, or
// at 0 if it is one of `special`, where query_alone.cpp is in trouble.
class Batch : public testing::Test {
 protected:
  void ask(int count, std::set<int> special, const std::string& words,
           const WorkerLimits& limits = {}) {
    std::vector<corpus::Case> cases;
    for (int i = 0; i < count; ++i) {
      const double from = special.contains(i) ? 0 : i + 1, to = from - 1024;
      const auto still = [](double x, double y) { return MovingPoint{{x, y, 0}, {x, y, 0}}; };
      const MovingPoint falling{{1, 1, from}, {1, 1, to}};
      cases.push_back(
          case_of_query({{falling, still(0, 0), still(4, 0), still(0, 4)}, 1}, "query"));
    }
    ::setenv("ASSAY_QUERY", words.c_str(), 1);
    worker.emplace(ASSAY_WORKER, plugin("query_alone"), limits);
    runs = worker->run(cases, plugin_alone);
    ::unsetenv("ASSAY_QUERY");
    ASSERT_EQ(runs.size(), cases.size());
    for (int i = 0; i < count; ++i) {
      if (special.contains(i)) continue;
      const auto& run = runs[static_cast<std::size_t>(i)];
      ASSERT_EQ(run.end, RunEnd::completed) << i << ": " << run.explanation;
      const double t = (i + 1) / 1024.;
      EXPECT_EQ(run.steps[0].first, (detector::TimeEnclosure{t, t})) << i;
      EXPECT_EQ(run.disturbances, 0u) << i;
    }
  }

  std::optional<WorkerProcess> worker;
  std::vector<CaseRun> runs;
};

TEST_F(Batch, ACrashIsThatOfItsCase) {
  const std::set<int> fatal = {150, 151, 400};
  ask(600, fatal, "abort-at-start");
  for (const int i : fatal) {
    EXPECT_EQ(runs[static_cast<std::size_t>(i)].end, RunEnd::crashed) << i;
    EXPECT_EQ(runs[static_cast<std::size_t>(i)].explanation, "killed by signal 6 (Aborted)");
  }
  EXPECT_EQ(worker->starts(), 1 + fatal.size());
  EXPECT_EQ(worker->disturbances(), 0u);
}

TEST_F(Batch, AHangIsThatOfItsCase) {
  ask(300, {130}, "burn-at-start=60", {.seconds = .3});
  EXPECT_EQ(runs[130].end, RunEnd::hung);
  EXPECT_EQ(worker->starts(), 2u);
}

TEST_F(Batch, ANeighbourDisturbsOneCaseAndIsNoCrash) {
  auto killer = neighbour(SIGKILL, 1, .2);
  ask(300, {130}, "burn-at-start=.6");
  killer.join();
  EXPECT_EQ(runs[130].end, RunEnd::completed) << runs[130].explanation;
  EXPECT_EQ(runs[130].steps[0].first, (detector::TimeEnclosure{0, 0}));
  EXPECT_EQ(runs[130].disturbances, 1u);
  EXPECT_EQ(worker->disturbances(), 1u);
  EXPECT_EQ(worker->starts(), 2u);
}

// As `assay run` does, and a shell that starts it in the background.
TEST(DisturbedWorker, WhatItsHostBlocksOrIgnoresEndsItAllTheSame) {
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &blocked, &before), 0);
  const auto quit_before = signal(SIGQUIT, SIG_IGN);
  {
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    worker.run(small_case(31, 0), plugin_alone);
    for (const int one_signal : {SIGTERM, SIGQUIT}) {
      kill(children().at(0), one_signal);
      EXPECT_EQ(worker.run(small_case(31, 1), plugin_alone)[0].disturbances, 1u) << one_signal;
    }
  }
  WorkerProcess worker(ASSAY_WORKER, plugin("terminates_itself"));
  EXPECT_EQ(worker.run(fatal_case(), plugin_alone)[0].explanation,
            "killed by signal 15 (Terminated), three times in a row");
  signal(SIGQUIT, quit_before);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST(DisturbedWorker, OtherSignalsAndExitsAreCrashesAtOnce) {
  const std::map<std::string, std::string> ends = {
      {"segfaults", "killed by signal 11 (Segmentation fault)"},
      {"aborts", "killed by signal 6 (Aborted)"},
      {"exit", "exited with code 0"}};
  const auto c = fatal_case();
  for (const auto& [name, explanation] : ends) {
    WorkerProcess worker(ASSAY_WORKER, plugin(name));
    const auto runs = worker.run(c, std::vector<Configuration>(2, plugin_alone[0]));
    for (const auto& run : runs) {
      EXPECT_EQ(run.end, RunEnd::crashed);
      EXPECT_EQ(run.explanation, explanation);
      EXPECT_EQ(run.disturbances, 0u);
    }
    EXPECT_EQ(worker.starts(), 2u) << name;
    EXPECT_EQ(worker.disturbances(), 0u);
  }
}

TEST(DisturbedWorker, RandomDeathsAreCountedAndChangeNoAnswer) {
  WorkerProcess worker(ASSAY_WORKER, plugin("killed_at_random"));
  WorkerProcess undisturbed(ASSAY_WORKER, plugin("wrapped_builtin"));
  std::uint64_t disturbances = 0, crashes = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto c = small_case(31, i);
    const auto run = worker.run(c, plugin_alone)[0];
    disturbances += run.disturbances;
    if (run.end == RunEnd::crashed) {
      EXPECT_TRUE(says(run.explanation, "three times in a row"));
      ++crashes;
    } else {
      EXPECT_TRUE(same_answers(run, undisturbed.run(c, plugin_alone)[0])) << c.id;
    }
  }
  EXPECT_GT(disturbances, 0u);
  EXPECT_EQ(worker.disturbances(), disturbances);
  EXPECT_EQ(worker.starts(), 1 + disturbances + 3 * crashes);
  EXPECT_LE(crashes, 5u);  // one time in 8,000 is expected
}

TEST(DisturbedWorker, ADeathBetweenTwoCasesIsCountedToo) {
  WorkerProcess worker(ASSAY_WORKER, std::nullopt);
  ASSERT_EQ(worker.run(small_case(31, 0), plugin_alone)[0].end, RunEnd::completed);
  test::end_child(children().at(0));
  const auto runs = worker.run(small_case(31, 1), std::vector<Configuration>(2, plugin_alone[0]));
  EXPECT_EQ(runs[0].end, RunEnd::completed);
  EXPECT_EQ(runs[0].disturbances, 1u);
  EXPECT_EQ(runs[1].disturbances, 0u);
  EXPECT_EQ(worker.disturbances(), 1u);
  EXPECT_EQ(worker.starts(), 2u);
}

TEST(DisturbedWorker, WithTheThreadThatStartedItItEndsUndisturbed) {
  WorkerProcess worker(ASSAY_WORKER, std::nullopt);
  std::thread([&] { worker.run(small_case(31, 0), plugin_alone); }).join();
  test::end_child(children().at(0), 0);
  EXPECT_EQ(worker.run(small_case(31, 1), plugin_alone)[0].disturbances, 0u);
  EXPECT_EQ(worker.disturbances(), 0u);
}

TEST(DisturbedWorker, LoadingIsTriedThreeTimes) {
  WorkerProcess worker(ASSAY_WORKER, plugin("kills_itself_while_loaded"));
  const auto description = worker.describe();
  ASSERT_FALSE(description);
  EXPECT_TRUE(says(description.error().message,
                   "ended while it was loaded: killed by signal 9 "
                   "(Killed), three times in a row"));
  EXPECT_EQ(worker.starts(), 3u);
  EXPECT_EQ(worker.disturbances(), 0u);
  EXPECT_EQ(worker.run(small_case(31, 0), plugin_alone)[0].end, RunEnd::not_run);
}

// It was loaded before, so that it dies now is its own doing and no fault of the harness.
TEST(DisturbedWorker, APlugInThatDiesWhenItIsLoadedAgainHasCrashed) {
  // Not in a scratch folder, for who has no rights does not see into one of root.
  const auto file =
      std::filesystem::temp_directory_path() / ("assay-loaded-" + std::to_string(::getpid()));
  ::setenv("ASSAY_TEST_FILE", file.c_str(), 1);
  WorkerProcess worker(ASSAY_WORKER, plugin("crashes_when_loaded_again"));
  ASSERT_TRUE(worker.describe());
  std::ofstream(file) << "loaded";
  test::end_child(children().at(0));
  const auto run = worker.run(small_case(31, 0), plugin_alone)[0];
  ::unsetenv("ASSAY_TEST_FILE");
  std::filesystem::remove(file);
  EXPECT_EQ(run.end, RunEnd::crashed);
  EXPECT_TRUE(says(run.explanation, "ended while it was loaded: killed by signal 11"));
}

// What the system does not give says nothing of the harness, so it is told apart from what goes
// wrong in the work itself.
TEST(InACopy, WhatTheSystemDoesNotGiveIsASystemError) {
  const auto nothing = [](const Say&) {};
  rlimit files;
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &files), 0);
  const rlimit none = {0, files.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  int said = 0;
  try {
    in_a_copy(nothing);
  } catch (const std::system_error& failure) {
    said = failure.code().value();
  }
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &files), 0);
  EXPECT_EQ(said, EMFILE);
  EXPECT_EQ(in_a_copy(nothing).end.code, 0);
  // What the work throws is thrown.
  try {
    in_a_copy([](const Say&) { throw std::runtime_error("of the work"); });
    ADD_FAILURE();
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "of the work");
    EXPECT_EQ(dynamic_cast<const std::system_error*>(&failure), nullptr);
  }
}

}  // namespace
}  // namespace assay::properties
