// A process and what it started, as /proc shows them from outside.
#pragma once

#include <sys/types.h>

namespace assay::properties {

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

}  // namespace assay::properties
