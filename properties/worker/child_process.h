// Starts processes, which are always waited for; does work in a copy of this process, so that a
// crash ends only the copy; and watches a worker, to decide when its time is over.
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

// The number of an open file of this process, which is closed with this object. Negative: none.
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

// The descriptor of the child's end of the channel.
inline constexpr int child_descriptor = 3;

// An open file of this process, and its number in the child. REQUIRES that no earlier file of a
// list has the number `here` in the child; no file has it if `here` is least_passed_descriptor or
// more.
struct PassedDescriptor {
  int here, there;
};
inline constexpr int least_passed_descriptor = 10;

struct ChildEnd {
  int signal = 0;        // the signal that killed it; 0: it exited
  int code = 0;          // the code that it exited with
  bool by_host = false;  // the host killed it, because it did not end in time
  // The end in words: "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty when
  // by_host.
  std::string text;
};

// Returns the end of a child that a signal killed.
ChildEnd end_by_signal(int signal);

// Waits for the end of a child of this process. REQUIRES that the child was not waited for before.
ChildEnd end_of_child(pid_t id);

// Returns whether the child was killed by a signal that no error in a process causes, and that the
// host did not send. These are SIGKILL and SIGTERM, which an administrator, a job queue or a
// machine short of memory sends, and SIGINT, SIGHUP and SIGQUIT, which come from a terminal that is
// closed or interrupted. The child may also send them to itself on purpose.
bool was_killed_from_outside(const ChildEnd& end);

// A child process. It leads a session and a process group of its own, so that it has no terminal,
// and ctrl-C reaches the host alone.
// It starts with no signal blocked or ignored, even if the host, or the shell that started the
// host, ignores some. Otherwise a detector could outlive a signal that would end it anywhere else.
class ChildProcess {
 public:
  // Starts the program with an empty stdin. A program named without a folder is searched for as by
  // a shell. The problem states the system's reason.
  static Expected<ChildProcess> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments,
                                      const std::vector<PassedDescriptor>& descriptors);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Returns whether the child has ended. Does not wait, and does not reap the child.
  bool has_ended() const;

  // Waits for the child's end, and kills it if that takes longer than `patience` of wall clock.
  // Then kills the rest of its process group, because processes that the child started would go on
  // to no purpose. REQUIRES that finish() was not called before; a second call says that the child
  // exited with code 0.
  ChildEnd finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: none, or waited for
};

struct CopyRun {
  std::string output;  // all text told by the work, even if it crashed later
  ChildEnd end;        // exited with code 0, if the work returned
};

// Tells the text to the original process. The text is kept if the copy crashes; it is read when the
// copy has ended.
using Say = std::function<void(std::string_view)>;

// Makes a copy of this process, runs the work in it and waits for its end, however long that takes.
// The copy has one thread, and none of the open files, so it holds no lock and no pipe longer than
// this process does. The work must not wait for another thread of this process.
// Throws the exception of the work, as std::bad_alloc or as std::runtime_error with its text, and
// std::system_error if the system gives no process or no descriptor for the copy.
// Cost: about a millisecond for a process of 100 MB.
CopyRun in_a_copy(const std::function<void(const Say&)>& work);

// Decides when the time of a worker is over. The limit is one of processor time, so that the
// verdict does not depend on the load of the machine. A worker that uses no processor time is
// caught by wider limits of wall clock.
//
// A worker that answers soon is not measured: no process can use up the limit before the wall clock
// has reached the limit divided by the number of processors. After that /proc is read about once a
// second, and more often towards the end.

// Measures the processor time that a process uses, with all its threads and all processes that it
// starts. It measures from outside, so that code in the process has no influence.

// A process and the processes that it started, as /proc shows them from outside.
struct ProcessTree {
  // Processor time in seconds of the processes that the root started, that these started, and so
  // on: of living ones, and of ended ones for which their parents have waited. The threads of the
  // root itself and of `apart` do not count. Each process counts up to 0.01 s too little, because
  // /proc counts in ticks. The time of a process is lost if its parent does not wait for it.
  double descendant_seconds = 0;
  // Every thread of each process waits for something other than a processor, or was stopped by a
  // signal: a process may do both to itself. A process that a debugger holds is not asleep.
  bool is_asleep = false;
};

// Measures the processes of `root`. A member of its process group counts as started by root even if
// its own parent has ended; a process that left the group and lost its parents is not found. Reads
// one file for each process of the machine: about 5 us each. REQUIRES a root that leads its process
// group.
ProcessTree look_at(pid_t root, pid_t apart = 0);

// Measures seconds of processor time since a beginning: the construction or the last lap().
//
// The threads of the process, ended ones included, are measured to the nanosecond; that takes 0.2
// us. If another process does the work (a worker behind bwrap), that one is measured in this way,
// and the process itself is not counted.
//
// Started processes are measured only when look() is called. Time that they used before the first
// look() since the beginning is not counted, because it may be of earlier work. So the result is
// too short by this time, and by the losses that ProcessTree states. It is never too long.
class ProcessorTime {
 public:
  // Begins to measure `process`. `worker` is the process that does the work, a descendant of
  // `process`; 0: `process` itself. REQUIRES that `process` is a child of this process that leads
  // its process group and was not waited for; a child that has ended can still be read.
  explicit ProcessorTime(pid_t process, pid_t worker = 0);

  // Returns the seconds since the beginning. Started processes count as of the last look().
  double seconds() const;
  // Returns seconds(), and begins anew at that point.
  double lap();
  // Measures the started processes too. About 5 us for each process of the machine.
  ProcessTree look();

 private:
  double own_seconds() const;

  pid_t process_, worker_;
  std::optional<clockid_t> clock_;
  double begin_ = 0;                        // of own_seconds()
  std::optional<double> of_others_before_;  // their use at the first look
  double of_others_ = 0;                    // their use since then
};

// The wider limits, as multiples of the limit of processor time.
inline constexpr double asleep_limit = 10;  // wall clock in which the worker only slept
inline constexpr double wall_limit = 100;   // wall clock in all

class WorkerWatch {
 public:
  // Begins the first case. Each case may take `seconds` of processor time, used by the worker with
  // its threads and by all processes that it started. `worker` must outlive this object. `plugin`
  // is the process of the plug-in if the worker is bwrap, which started it; 0: none, or unknown.
  WorkerWatch(const ChildProcess& worker, double seconds, pid_t plugin = 0);

  // Returns how long to wait for the worker before asking again. Nothing if waiting is over: then
  // why() says why. 0 if the worker has_ended(): its messages are still read. A worker exceeds its
  // limit by at most a hundredth of it (at least 1 ms) on each processor.
  std::optional<std::chrono::milliseconds> patience();

  // Returns the processor seconds of the case so far, and begins the next case.
  double next_case();

  // Returns "no answer in 10 s of processor time", followed by ": asleep for 100 s" or the like if
  // another limit ended the case. Only limits are named, so that two such ends have equal texts.
  std::string why() const;
  // Returns whether the worker ended although its end of the channel is still open, because a
  // process that it started holds the channel open.
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
  double asleep_ = 0;   // of these, seconds in which the worker slept
  End end_ = End::none;
};

}  // namespace assay::properties
