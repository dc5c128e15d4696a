// The limits of time of the worker: processor time, wherever it is used, and longer limits of
// wall-clock time for runs that use no processor time. No test here requires that something ends
// soon.
#include <sys/prctl.h>
#include <sys/ptrace.h>

#include "properties/worker/child_process.h"
#include "properties/worker/messages.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/small_case.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using test::burning_case, test::children, test::comes_true, test::plugin, test::plugin_alone,
    test::small_case;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

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
  std::vector<std::jthread> neighbours(6);
  for (auto& neighbour : neighbours)
    neighbour = std::jthread([](std::stop_token stop) {
      while (!stop.stop_requested()) {
      }
    });
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
  double sum = 0;
  for (const auto& run : runs) {
    // The host reads the clock when it has the answer, and the worker goes on meanwhile: a part may
    // count for the run before.
    EXPECT_GT(run.processor_seconds, 0);
    sum += run.processor_seconds;
  }
  EXPECT_GE(sum, 3 * used);
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
    EXPECT_EQ(run.explanation,
              is_debugged ? "no answer in 0.05 s of processor time, nor in 5 s by the clock"
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

// Processor time of a process seen from outside: where it may be used, and how sleep is told.

constexpr double burnt_seconds = .1;  // seconds of processor time
constexpr double tick = .01;

void burn(double seconds) {
  const auto now = [] {
    timespec t = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double until = now() + seconds;
  while (now() < until) {
  }
}

// A child that leads its process group, does something when it is told to, then says so and sleeps.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work) {
    if (pipe(go_) != 0 || pipe(done_) != 0) ADD_FAILURE();
    id_ = fork();
    if (id_ == 0) {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      char byte = 0;
      if (write(done_[1], &byte, 1) == 1 && read(go_[0], &byte, 1) == 1) {
        work();
        if (write(done_[1], &byte, 1) == 1) sleep(60);
      }
      _exit(0);
    }
    wait_until_done();
  }
  ~Worker() {
    kill(-id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    for (const int end : {go_[0], go_[1], done_[0], done_[1]}) close(end);
  }
  void work() {
    const char byte = 0;
    if (write(go_[1], &byte, 1) != 1) ADD_FAILURE();
    wait_until_done();
  }
  pid_t id() const { return id_; }

 private:
  void wait_until_done() {
    char byte;
    if (read(done_[0], &byte, 1) != 1) ADD_FAILURE();
  }
  int go_[2], done_[2];
  pid_t id_;
};

// Of the work alone, by the one clock and by the other.
double used_by(const std::function<void()>& work) {
  Worker worker(work);
  ProcessorTime time(worker.id());
  time.look();
  worker.work();
  time.look();
  return time.seconds();
}

void in_child(const std::function<void()>& work, bool and_wait) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  if (and_wait) waitpid(child, nullptr, 0);
}

TEST(ProcessorTime, IsSeenWhereverItIsUsed) {
  const auto burn_briefly = [] { burn(burnt_seconds); };
  EXPECT_GE(used_by(burn_briefly), burnt_seconds);
  EXPECT_GE(used_by([&] { std::thread(burn_briefly).join(); }), burnt_seconds);
  EXPECT_GE(used_by([&] { in_child(burn_briefly, true); }), burnt_seconds - tick);
  EXPECT_GE(used_by([&] { in_child([&] { in_child(burn_briefly, true); }, true); }),
            burnt_seconds - 2 * tick);
}

TEST(ProcessorTime, IsSeenInProcessesThatHaveLostTheirParents) {
  Worker worker([] { in_child([] { in_child([] { burn(60); }, false); }, true); });
  ProcessorTime time(worker.id());
  time.look();
  worker.work();
  bool is_asleep = false;
  while (time.seconds() < burnt_seconds) is_asleep |= time.look().is_asleep;
  EXPECT_FALSE(is_asleep);
}

TEST(ProcessorTime, WhatWasUsedBeforeTheBeginningIsNotCounted) {
  Worker worker([] {
    burn(burnt_seconds);
    in_child([] { burn(burnt_seconds); }, true);
  });
  ProcessorTime time(worker.id());
  worker.work();
  EXPECT_GE(time.lap(), burnt_seconds);
  time.look();
  time.look();
  EXPECT_LT(time.seconds(), burnt_seconds / 2);
}

TEST(ProcessorTime, CanBeReadOfOneThatHasEnded) {
  Worker worker([] { burn(burnt_seconds); });
  ProcessorTime time(worker.id());
  worker.work();
  test::end_child(worker.id());
  EXPECT_GE(time.seconds(), burnt_seconds);
}

TEST(ProcessTree, TellsSleepFromWork) {
  Worker worker([] {
    // A thread that works beside one that sleeps.
    std::thread([] { burn(burnt_seconds); }).detach();
  });
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
  worker.work();
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
}

TEST(ProcessTree, AThreadThatWorksIsNotAsleepUntilItIsStopped) {
  Worker worker([] { std::thread([] { burn(60); }).detach(); });
  worker.work();
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(look_at(worker.id()).is_asleep);
  kill(worker.id(), SIGSTOP);
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
}

}  // namespace
}  // namespace assay::properties
