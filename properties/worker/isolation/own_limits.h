// The limits that the worker of a plug-in sets for itself before it loads the plug-in.
#pragma once

#include <cstdint>

namespace assay::properties {

// Limits the bytes of address space of this process and of each process that it starts; 0: no
// limit. A lower limit that the user has set stays. False if the system refuses.
bool limit_memory(std::uint64_t bytes);

// Limits, besides, the bytes of each file that it writes, to the same number. A file that would
// grow beyond is an error of the call, and not the end of the process. Limits the processes and
// threads that it may start, to 512 more than there are now: as root the workers of all runs are of
// one user.
//
// The system exempts root from the limit on processes, by the real user of a process and by its
// rights. So if this is root, it becomes another real user and gives up its rights; as whom files
// are opened stays as it is. REQUIRES that this process has one thread.
bool limit_plugin(std::uint64_t bytes);

// If the machine itself runs out of memory, the system ends this process, and what it starts,
// before any other. Many processes together may take more than the machine has, although each
// keeps its limit.
void end_first_without_memory();

}  // namespace assay::properties
