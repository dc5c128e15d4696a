// A started process, which is always waited for; work in a copy of this process, in which a crash
// stays; and the watch that decides when a worker, which is such a process, has had its time.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/problem.h"

namespace assay::properties {

// The descriptor under which the child finds its end of the channel.
inline constexpr int child_descriptor = 3;

// An open file of this process, and the number under which the child has it. REQUIRES that `here`
// is no number that another file gets there: least_passed_descriptor or more is none, and the
// first of a list may have any number.
struct PassedDescriptor {
  int here, there;
};
inline constexpr int least_passed_descriptor = 10;

struct ChildEnd {
  int signal = 0;        // the signal that killed it; 0: it exited
  int code = 0;          // the code that it exited with
  bool by_host = false;  // the host killed it, because it did not end in time
  // "killed by signal 11 (Segmentation fault)", "exited with code 0"; empty when by_host.
  std::string text;
};

// The end of one that a signal killed.
ChildEnd end_by_signal(int signal);

// Waits for the end of a child of this process. REQUIRES that nobody has waited for it.
ChildEnd end_of_child(pid_t id);

// Whether the child was killed by a signal that no error in a process brings about, and that the
// host did not send. These are SIGKILL and SIGTERM, which an administrator, a job queue or a
// machine short of memory sends, and SIGINT, SIGHUP and SIGQUIT, which come from a terminal that
// is closed or interrupted. The child may also send them to itself on purpose.
bool was_killed_from_outside(const ChildEnd& end);

// The child leads a session and a process group of its own, so that it has no terminal, and ctrl-C
// reaches the host alone.
// It starts with no signal blocked or ignored, even if the host, or the shell that started the
// host, ignores some. Otherwise a detector could outlive a signal that would end it anywhere else.
class ChildProcess {
 public:
  // Starts the program with an empty stdin. One that is named without a folder is searched for as
  // by a shell. The problem states the system's reason.
  static Expected<ChildProcess> start(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments,
                                      const std::vector<PassedDescriptor>& descriptors);
  ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  // waits a fifth of a second, then kills

  pid_t id() const { return id_; }

  // Whether the child has ended. Does not wait, and does not reap the child.
  bool has_ended() const;

  // Waits for the child's end, and kills it if that takes longer than `patience` of wall clock.
  // Then kills what is left of its process group, because what the child started would go on for
  // nobody. REQUIRES that it was not called before; a second call says that the child exited with
  // code 0.
  ChildEnd finish(std::chrono::milliseconds patience);

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;  // -1: none, or waited for
};

struct CopyRun {
  std::string output;  // all that the work said, also if it crashed afterwards
  ChildEnd end;        // exited with code 0, if the work returned
};

// Tells the text to the process that the copy was made of. What was said is kept if the copy
// crashes; it is read when the copy has ended.
using Say = std::function<void(std::string_view)>;

// Makes a copy of this process, runs the work in it and waits for its end, however long that takes.
// The copy has one thread, and none of the open files: it holds no lock and no pipe any longer
// than this process does. The work must not wait for another thread of this process.
// Throws what the work threw, as std::bad_alloc or as std::runtime_error with its text, and
// std::system_error if the system gives no process or no descriptor for the copy.
// Cost: about a millisecond for a process of 100 MB.
CopyRun in_a_copy(const std::function<void(const Say&)>& work);

// Decides when a worker has had its time. The limit is one of processor time, so that the verdict
// does not depend on what else the machine does. A worker that uses no processor time is caught by
// wider limits of wall clock.
//
// A worker that answers soon is not looked at: before the wall clock has reached the limit divided
// by the number of processors, no process can have used it up. After that /proc is read about once
// a second, and more often towards the end.

// The processor time that a process uses, with all its threads and all processes that it starts.
// It is measured from outside, so that what runs in the process has no influence on it.

// A process and what it started, as /proc shows them from outside.
struct ProcessTree {
  // Processor time in seconds of the processes that the root started, that those started, and so
  // on: of those that live, and of those that ended and that their parents have waited for. The
  // threads of the root itself and of `apart` do not count. Each process counts up to 0.01 s too
  // little, because /proc counts in ticks. What a process used is lost if it ends and its parent
  // does not wait for it.
  double descendant_seconds = 0;
  // Every thread of each of them waits for something other than a processor, or was stopped by a
  // signal: a process may do both to itself. One that a debugger holds is not asleep.
  bool is_asleep = false;
};

// Looks at the processes of `root`. A member of its process group counts as started by root even
// if its own parent has ended; a process that left the group and lost its parents is not found.
// Reads one file for each process of the machine: about 5 us each. REQUIRES that root leads its
// process group.
ProcessTree look_at(pid_t root, pid_t apart = 0);

// Seconds of processor time since a beginning, which is the construction or the last lap().
//
// The threads of the process, ended ones included, are measured to the nanosecond; that takes 0.2
// us. If another process does the work for it (a worker behind bwrap), that one is measured
// in this way, and the process itself is not counted.
//
// The processes that it started are measured only when look() is called. What they used before the
// first look() since the beginning is not counted, because it may be of work done before. So the
// time is too short by what they use until then, and further by what ProcessTree says. It is
// never too long.
class ProcessorTime {
 public:
  // Begins to measure `process`. `worker` is the one that does the work, a descendant of
  // `process`; 0: `process` itself. REQUIRES that `process` is a child of this process that leads
  // its process group and was not waited for; one that has ended can still be read.
  explicit ProcessorTime(pid_t process, pid_t worker = 0);

  // The seconds since the beginning. Other processes count as they were when last looked at.
  double seconds() const;
  // Returns the same, and begins anew at that point.
  double lap();
  // Also measures the processes that were started. About 5 us for each process of the machine.
  ProcessTree look();

 private:
  double own_seconds() const;

  pid_t process_, worker_;
  std::optional<clockid_t> clock_;
  double begin_ = 0;                        // of own_seconds()
  std::optional<double> of_others_before_;  // what they had used at the first look
  double of_others_ = 0;                    // what they have used since then
};

// The wider limits, as multiples of the limit of processor time.
inline constexpr double asleep_limit = 10;  // wall clock in which the worker only slept
inline constexpr double wall_limit = 100;   // wall clock in all

class WorkerWatch {
 public:
  // Allows `seconds` of processor time for each case, used by the worker with its threads and by
  // all processes that it started, and begins the first case. `worker` must outlive this object.
  // `plugin` is the process of the plug-in, if the worker is bwrap before it; 0: none, or unknown.
  WorkerWatch(const ChildProcess& worker, double seconds, pid_t plugin = 0);

  // How long to wait for the worker before asking this again. Nothing if waiting is over: then
  // why() says why. 0 if the worker has_ended(): what it said before is still read. A worker
  // exceeds its limit by at most a hundredth of it (at least 1 ms) on each processor.
  std::optional<std::chrono::milliseconds> patience();

  // Returns the processor seconds of the case so far, and begins the next case.
  double next_case();

  // "no answer in 10 s of processor time", followed by ": asleep for 100 s" or the like if another
  // limit ended the case. Only limits are named, so that two such ends read the same.
  std::string why() const;
  // The worker ended, but its end of the channel is still open, because a process that it started
  // holds it open.
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
  double asleep_ = 0;   // seconds of these in which it slept
  End end_ = End::none;
};

}  // namespace assay::properties
