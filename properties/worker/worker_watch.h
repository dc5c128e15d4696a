// Decides when a worker has had its time. The limit is one of processor time, so that the verdict
// does not depend on what else the machine does. A worker that uses no processor time is caught by
// wider limits of wall clock.
//
// A worker that answers soon is not looked at: before the wall clock has reached the limit divided
// by the number of processors, no process can have used it up. After that /proc is read about once
// a second, and more often towards the end.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "properties/worker/child_process.h"
#include "properties/worker/processor_time.h"

namespace assay::properties {

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
  double used_ = 0;     // processor seconds at the last look
  double watched_ = 0;  // seconds of wall clock until the last look
  double asleep_ = 0;   // seconds of these in which it slept
  End end_ = End::none;
};

}  // namespace assay::properties
