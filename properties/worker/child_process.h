// Starts processes and waits for their ends; does work in a copy of this process, so that a crash
// ends only the copy; and watches a worker, to decide when the worker's time is over.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

// Owns an open file of this process, and closes the file when the object is destroyed. A negative
// number stands for no file.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  operator int() const { return number_; }

 private:
  int number_;
};

// The descriptor by which a child finds its end of the channel to the host.
inline constexpr int child_descriptor = 3;

// The number of an open file in this process (`here`) and in the child (`there`). REQUIRES a `here`
// that is not the `there` of an earlier file in the list. A `here` of least_passed_descriptor or
// more always satisfies this.
struct PassedDescriptor {
  int here, there;
};
inline constexpr int least_passed_descriptor = 10;

struct ChildEnd {
  int signal = 0;        // the signal that killed it; 0: it exited
  int code = 0;          // the exit code of the child
  bool by_host = false;  // the host killed the child, because it did not end in time
  // The end in words: "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty if
  // by_host.
  std::string text;
};

// Returns the end of a child that a signal killed.
ChildEnd end_by_signal(int signal);

// Waits for the end of a child of this process. REQUIRES that the child was not waited for before.
ChildEnd end_of_child(pid_t id);

// Returns whether the child was killed by a signal that the host did not send, and that no error in
// a process causes. Such signals are SIGKILL and SIGTERM, which an administrator, a job queue or a
// machine short of memory sends, and SIGINT, SIGHUP and SIGQUIT, which come from a terminal that is
// closed or interrupted. A child can also send such a signal to itself on purpose.
bool was_killed_from_outside(const ChildEnd& end);

// A child process. It leads a session and a process group of its own, so that it has no terminal,
// and ctrl-C reaches only the host. It starts with no signal blocked or ignored, even if the host,
// or the shell that started the host, ignores some signals. Otherwise a detector could survive a
// signal that would end it anywhere else.
class ChildProcess {
 public:
  // Starts the program with an empty stdin. If the name of the program has no folder, searches for
  // the program in PATH as a shell does. The problem states the system's reason.
  static Expected<ChildProcess> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments,
                                      const std::vector<PassedDescriptor>& descriptors);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Returns whether the child has ended. Does not wait, and does not reap the child.
  bool has_ended() const;

  // Waits for the child's end, and kills the child if it does not end within `patience` of wall
  // clock. Then kills the rest of its process group, because processes that the child started have
  // no purpose any more. REQUIRES that finish() was not called before; a second call returns the
  // end of a child that exited with code 0.
  ChildEnd finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: no child, or finish() has waited for it
};

struct CopyRun {
  std::string output;  // all text that the work passed to Say, even if it crashed later
  ChildEnd end;        // exit with code 0 if the work returned
};

// Passes text from the copy to the original process, which reads the text when the copy has ended,
// also if the copy crashed.
using Say = std::function<void(std::string_view)>;

// Makes a copy of this process, runs the work in the copy, and waits without limit until the copy
// has ended. The copy has one thread and none of this process's open files, so it does not prolong
// any lock or pipe. The work must not wait for another thread of this process.
// If the work throws std::bad_alloc, throws the same; if the work throws another exception, throws
// std::runtime_error with its text. Throws std::system_error if the system gives no process or no
// descriptor for the copy. Cost: about a millisecond for a process of 100 MB.
CopyRun in_a_copy(const std::function<void(const Say&)>& work);

// The time of a worker is limited as follows. The limit is a limit of processor time, so that a
// verdict does not depend on the load of the machine. Wider limits of wall clock end a worker that
// uses no processor time.
//
// A worker that answers soon is not measured: no process can use up the limit before the wall clock
// has reached the limit divided by the number of processors. After that /proc is read about once a
// second, and more often as the limit comes near.
//
// The time is measured from outside of the worker, so that code in the worker has no influence.

// A process (the root) and the processes that it started, as /proc shows them.
struct ProcessTree {
  // Processor time in seconds of all descendants of the root. The time of a process that has ended
  // counts only if its parent has waited for it. The threads of the root itself and of `apart` do
  // not count. The value is up to 0.01 s too small for each process, because /proc counts in ticks.
  double descendant_seconds = 0;
  // Every thread of every process waits for something other than a processor, or was stopped by a
  // signal; a process can stop itself. A process that a debugger has stopped is not asleep.
  bool is_asleep = false;
};

// Measures the process tree of `root`. A member of the root's process group counts as a descendant
// even if its parent has ended. A process that left the group and whose parent has ended is not
// found. Reads one file for each process of the machine: about 5 us each. REQUIRES a root that
// leads its process group.
ProcessTree look_at(pid_t root, pid_t apart = 0);

// Measures seconds of processor time since a beginning: the construction or the last lap().
//
// The threads of the worker, including ended threads, are measured to the nanosecond, which takes
// 0.2 us. The processes that it started are measured only when look() is called. The time that they
// used before the first look() since the beginning is not counted, because it may belong to earlier
// work. So the result is too small by this time, and by the losses that ProcessTree states. The
// result is never too large.
class ProcessorTime {
 public:
  // Begins to measure. `worker` is the process that does the work; 0: `process` itself. If `worker`
  // is a descendant of `process`, such as a worker behind bwrap, the threads of `process` are not
  // counted.
  // REQUIRES that `process` is a child of this process that leads its process group and was not
  // waited for; the child can have ended.
  explicit ProcessorTime(pid_t process, pid_t worker = 0);

  // Returns the seconds since the beginning, with started processes as the last look() saw them.
  double seconds() const;
  // Returns seconds(), and begins again at that moment.
  double lap();
  // Measures the started processes too. About 5 us for each process of the machine.
  ProcessTree look();

 private:
  double own_seconds() const;

  pid_t process_, worker_;
  std::optional<clockid_t> clock_;
  double begin_ = 0;  // own_seconds() at the beginning
  // Processor seconds of the processes that the worker started: those before the first look(), and
  // those between the first and the last look().
  std::optional<double> of_others_before_;
  double of_others_ = 0;
};

// The limits of wall clock, as multiples of the limit of processor time.
inline constexpr double asleep_limit = 10;  // wall clock in which the worker only slept
inline constexpr double wall_limit = 100;   // wall clock in all

class WorkerWatch {
 public:
  // Begins the first case. Each case may use `seconds` of processor time, summed over the worker
  // with its threads and all processes that it started. `worker` must outlive this object. If
  // `worker` is bwrap, `plugin` is the process of the plug-in that bwrap started; 0: unknown.
  WorkerWatch(const ChildProcess& worker, double seconds, pid_t plugin = 0);

  // Returns how long to wait for the worker before the next call of this function. Returns nothing
  // if a limit was reached (why() names it), and 0 if the worker has_ended(), whose last messages
  // can then be read. On each processor the worker exceeds its limit by at most a hundredth of the
  // limit, or by 1 ms if that is more.
  std::optional<std::chrono::milliseconds> patience();

  // Returns the processor seconds of the case so far, and begins the next case.
  double next_case();

  // Returns "no answer in 10 s of processor time", followed by ": asleep for 100 s" or the like if
  // a limit of wall clock ended the case. The numbers are those of the limits, so that two cases
  // that end at the same limit have equal texts.
  std::string why() const;
  // Returns whether the worker has ended although the channel is still open, because a process that
  // the worker started keeps it open.
  bool has_ended() const { return end_ == End::ended; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class End { none, used_up, asleep, endless, ended };

  void begin();
  void look(Clock::time_point now);
  void plan_next_look(Clock::time_point now, double seconds);

  const ChildProcess& worker_;
  double limit_;
  ProcessorTime time_;
  Clock::time_point last_look_, next_look_;
  double seconds_ = 0;  // processor seconds at the last look
  double watched_ = 0;  // seconds of wall clock until the last look
  double asleep_ = 0;   // how many of these seconds the worker slept
  End end_ = End::none;
};

}  // namespace assay::properties
