// The processor time that a process uses, with all its threads and all processes that it starts,
// measured from outside, so that what runs in it has no say.
#pragma once

#include <sys/types.h>

#include <ctime>
#include <optional>

#include "properties/worker/process_tree.h"

namespace assay::properties {

// Seconds of processor time since a beginning. The process' own threads, ended ones included, are
// measured to the nanosecond; that takes 0.2 us. Where another process does the work for it (a
// plug-in behind its keeper), that one is measured so, and it itself is not counted. The processes
// that it started are measured only when look() is called. What they used before the first look
// since the beginning is not counted, for it may be of work done before: the time is short by what
// they use until then. It is further short by what process_tree.h says, and never too long.
class ProcessorTime {
 public:
  // REQUIRES a child of this process that leads its process group and was not waited for: one that
  // has ended can still be read. Begins.
  // `worker`: the one that does the work, a descendant of process; 0: process itself.
  explicit ProcessorTime(pid_t process, pid_t worker = 0);

  // Since the beginning; of other processes, as they were when last looked at.
  double seconds() const;
  // The same, and begins anew at that point.
  double lap();
  // Measures the processes that it started too. About 5 us for each process of the machine.
  ProcessTree look();

 private:
  double own_seconds() const;

  pid_t process_, worker_;
  std::optional<clockid_t> clock_;
  double begin_ = 0;                        // of own_seconds()
  std::optional<double> of_others_before_;  // at the first look since the beginning
  double of_others_ = 0;                    // since then
};

}  // namespace assay::properties
