// Processor time of a process seen from outside: where it may be used, and how sleep is told.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "properties/worker/worker_watch.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

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
  void go() {
    const char byte = 0;
    if (write(go_[1], &byte, 1) != 1) ADD_FAILURE();
  }
  void wait_until_done() {
    char byte;
    if (read(done_[0], &byte, 1) != 1) ADD_FAILURE();
  }
  pid_t id() const { return id_; }

 private:
  int go_[2], done_[2];
  pid_t id_;
};

// Of the work alone, by the one clock and by the other.
double used_by(const std::function<void()>& work) {
  Worker worker(work);
  ProcessorTime time(worker.id());
  time.look();
  worker.go();
  worker.wait_until_done();
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
  worker.go();
  worker.wait_until_done();
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
  worker.go();
  worker.wait_until_done();
  EXPECT_GE(time.lap(), burnt_seconds);
  time.look();
  time.look();
  EXPECT_LT(time.seconds(), burnt_seconds / 2);
}

TEST(ProcessorTime, CanBeReadOfOneThatHasEnded) {
  Worker worker([] { burn(burnt_seconds); });
  ProcessorTime time(worker.id());
  worker.go();
  worker.wait_until_done();
  kill(worker.id(), SIGKILL);
  siginfo_t seen = {};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(worker.id()), &seen, WEXITED | WNOWAIT), 0);
  EXPECT_GE(time.seconds(), burnt_seconds);
}

// Until it is so, or for a minute.
bool comes_true(const std::function<bool()>& holds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

TEST(ProcessTree, TellsSleepFromWork) {
  Worker worker([] {
    // A thread that works beside one that sleeps.
    std::thread([] { burn(burnt_seconds); }).detach();
  });
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
  worker.go();
  worker.wait_until_done();
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
}

TEST(ProcessTree, WhatIsStoppedSleepsEvenIfItHadWorkToDo) {
  Worker worker([] { std::thread([] { burn(60); }).detach(); });
  worker.go();
  worker.wait_until_done();
  kill(worker.id(), SIGSTOP);
  EXPECT_TRUE(comes_true([&] { return look_at(worker.id()).is_asleep; }));
}

TEST(ProcessTree, AThreadThatWorksIsNotAsleep) {
  Worker worker([] { std::thread([] { burn(60); }).detach(); });
  worker.go();
  worker.wait_until_done();
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(look_at(worker.id()).is_asleep);
}

}  // namespace
}  // namespace assay::properties
