// A process and what it started, as /proc shows them from outside.
#pragma once

#include <sys/types.h>

namespace assay::properties {

struct ProcessTree {
  // Processor time in seconds of the processes that the root started, that those started, and so
  // on: of the living, and of the ended that their parents have waited for. The time of the
  // threads of the root itself, and of `apart`, is not in it. Each process is up to 0.01 s short,
  // for /proc counts in ticks. What a process used is lost when it ends and its parent does not
  // wait for it.
  double descendant_seconds = 0;
  // Every thread of every one of them waits for something other than a processor or a disk. A
  // process that was stopped (SIGSTOP, a debugger) is not asleep.
  bool is_asleep = false;
};

// REQUIRES that root leads its process group: a member of the group counts as started by root even
// when its own parent has ended. Who left the group and lost its parents is not found. Reads a
// file for each process of the machine: about 5 us each.
ProcessTree look_at(pid_t root, pid_t apart = 0);

}  // namespace assay::properties
