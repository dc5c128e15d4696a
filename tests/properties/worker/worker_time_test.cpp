// The worker's limits of time: processor time wherever it is used, and wider nets of wall clock for
// what uses none. No test here asks that something be over soon.
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include "properties/worker/channel.h"
#include "properties/worker/child_process.h"
#include "properties/worker/worker_process.h"
#include "properties/worker/worker_watch.h"
#include "tests/properties/small_case.h"
#include "tests/properties/worker/children.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using test::burning_case, test::children, test::plugin, test::plugin_alone, test::small_case;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Threads that use all processors that they get, until the end of its life.
class BusyLoops {
 public:
  explicit BusyLoops(int count) {
    for (int i = 0; i < count; ++i) {
      threads_.emplace_back([this] {
        const auto longest = Clock::now() + std::chrono::minutes(1);
        while (!ended_ && Clock::now() < longest) {
        }
      });
    }
  }
  ~BusyLoops() {
    ended_ = true;
    for (auto& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> ended_ = false;
  std::vector<std::thread> threads_;
};

TEST(WorkerTime, WhatIsSaidBeforeTheEndIsHeardAfterIt) {
  auto ends = Channel::connected();
  ASSERT_TRUE(ends);
  auto& [host, worker] = *ends;
  const std::string says = R"(printf '\005\000\000\000\000\000\000\000hello' >&)";
  auto child = ChildProcess::start("/bin/sh", {"-c", says + std::to_string(child_descriptor)},
                                   {{worker.descriptor(), child_descriptor}});
  ASSERT_TRUE(child);
  WorkerWatch watch(child.value(), .05);
  // The host is so slow that it looks at the worker before it reads.
  while (!watch.has_ended()) ASSERT_TRUE(watch.patience()) << watch.why();
  const Patience patience = [&] { return watch.patience(); };
  std::string message;
  EXPECT_EQ(host.receive(message, patience), Transfer::done);
  EXPECT_EQ(message, "hello");
  EXPECT_EQ(host.receive(message, patience), Transfer::timed_out);
}

TEST(WorkerTime, ProcessorTimeIsLimitedWhereverItIsUsed) {
  constexpr double limit = .3, much = 1e6;
  for (const char* name : {"burns_time", "burns_in_thread", "burns_in_child"}) {
    WorkerProcess worker(ASSAY_WORKER, plugin(name), {.seconds = limit});
    const auto run = worker.run(burning_case(much), plugin_alone)[0];
    EXPECT_EQ(run.end, RunEnd::hung) << name;
    EXPECT_EQ(run.explanation, "no answer in 0.3 s of processor time") << name;
    EXPECT_GE(run.processor_seconds, limit) << name;
    std::printf("%s: ended at %.3f s of processor time, limit %g s\n", name, run.processor_seconds,
                limit);
    EXPECT_TRUE(children().empty());
    // The limit is for each case alone.
    for (int i = 0; i < 4; ++i) {
      const auto enough = worker.run(burning_case(limit / 2), plugin_alone)[0];
      EXPECT_EQ(enough.end, RunEnd::completed) << name << ": " << enough.explanation;
    }
    EXPECT_EQ(worker.starts(), 2u);
  }
}

TEST(WorkerTime, TheLimitIsReachedNoSoonerBesideBusyLoops) {
  constexpr double limit = .6, needed = .4;
  const BusyLoops neighbours(6);
  for (const char* name : {"burns_time", "burns_in_thread", "burns_in_child"}) {
    WorkerProcess worker(ASSAY_WORKER, plugin(name), {.seconds = limit});
    const auto begin = Clock::now();
    const auto run = worker.run(burning_case(needed), plugin_alone)[0];
    EXPECT_EQ(run.end, RunEnd::completed) << name << ": " << run.explanation;
    std::printf("%s: %.3f s of processor time in %.3f s, limit %g s\n", name, run.processor_seconds,
                seconds_since(begin), limit);
    EXPECT_LT(run.processor_seconds, limit);
  }
}

TEST(WorkerTime, AShortRunSaysWhatItTook) {
  // Longer than a busy machine keeps the host from reading the clock.
  constexpr double used = .15;
  WorkerProcess worker(ASSAY_WORKER, plugin("burns_time"));
  const auto runs = worker.run(burning_case(used), std::vector<Configuration>(3, plugin_alone[0]));
  for (const auto& run : runs) {
    // The host reads the clock when it has the answer, and the worker goes on meanwhile: a part may
    // count for the run before.
    EXPECT_GT(run.processor_seconds, 0);
  }
  EXPECT_GE(runs[0].processor_seconds + runs[1].processor_seconds + runs[2].processor_seconds,
            3 * used);
}

TEST(WorkerTime, WhatSleepsIsCaughtByTheWallClock) {
  constexpr double limit = .1;
  WorkerProcess worker(ASSAY_WORKER, plugin("hang"), {.seconds = limit});
  const auto begin = Clock::now();
  const auto run = worker.run(small_case(31, 0), plugin_alone)[0];
  EXPECT_EQ(run.end, RunEnd::hung);
  EXPECT_EQ(run.explanation, "no answer in 0.1 s of processor time: asleep for 1 s");
  EXPECT_GE(seconds_since(begin), 10 * limit);
  EXPECT_LT(run.processor_seconds, limit);
}

// A process that holds another one as a debugger does, until the end of its life.
class Debugger {
 public:
  explicit Debugger(pid_t held) {
    std::array<int, 2> ends;
    if (pipe(ends.data()) != 0) return;
    id_ = fork();
    if (id_ == 0) {
      const bool holds = ptrace(PTRACE_SEIZE, held, nullptr, nullptr) == 0 &&
                         ptrace(PTRACE_INTERRUPT, held, nullptr, nullptr) == 0 &&
                         waitpid(held, nullptr, __WALL) == held;
      if (write(ends[1], holds ? "y" : "n", 1) != 1) _exit(1);
      waitpid(held, nullptr, __WALL);  // its end is told to the debugger first
      for (;;) pause();
    }
    char answer = 'n';
    holds_ = read(ends[0], &answer, 1) == 1 && answer == 'y';
    close(ends[0]);
    close(ends[1]);
  }
  ~Debugger() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  bool holds() const { return holds_; }

 private:
  pid_t id_ = -1;
  bool holds_ = false;
};

// One that was stopped sleeps. One that a debugger holds does not, and so has longer.
TEST(WorkerTime, WhatIsStoppedSleepsAndWhatIsDebuggedDoesNotAndSendingEndsToo) {
  // A request that no socket takes at once, to a worker that does not read.
  corpus::Case c = small_case(31, 0);
  c.triangles.resize(1'000'000, 3);
  c.triangles.setZero();
  constexpr double limit = .05;
  for (const bool is_debugged : {false, true}) {
    WorkerProcess worker(ASSAY_WORKER, std::nullopt, {.seconds = limit});
    ASSERT_TRUE(worker.describe());
    const pid_t child = children().at(0);
    std::optional<Debugger> debugger;
    if (is_debugged) {
      debugger.emplace(child);
      if (!debugger->holds()) GTEST_SKIP() << "this user may not debug";
    } else {
      kill(child, SIGSTOP);
    }
    const auto begin = Clock::now();
    const auto run = worker.run(c, plugin_alone)[0];
    EXPECT_EQ(run.end, RunEnd::hung);
    EXPECT_EQ(run.explanation, is_debugged
                                   ? "no answer in 0.05 s of processor time, nor in 5 s"
                                   : "no answer in 0.05 s of processor time: asleep for 0.5 s");
    EXPECT_GE(seconds_since(begin), (is_debugged ? 100 : 10) * limit);
    EXPECT_EQ(run.disturbances, 0u);
  }
}

TEST(WorkerTime, LoadingIsLimitedToo) {
  WorkerProcess worker(ASSAY_WORKER, plugin("hang_while_loaded"), {.seconds = .1});
  const auto description = worker.describe();
  ASSERT_FALSE(description);
  EXPECT_EQ(description.error().message,
            plugin("hang_while_loaded") +
                ": hung while it was loaded: no answer in 0.1 s of processor time: asleep for 1 s");
  EXPECT_EQ(worker.starts(), 1u);
  EXPECT_TRUE(children().empty());
}

}  // namespace
}  // namespace assay::properties
