// Uses Landlock so that this process, and what it starts, writes to no file outside of some
// folders.
#pragma once

#include <string>
#include <vector>

namespace assay::properties {

// Holds from now on and for ever, for the calling thread and all that it starts afterwards. Files
// are opened for writing, made and removed below `folders` alone; /dev/null and its like may be
// written to. Everything may be read and run, except /proc if `without_proc`. As far as the
// kernel's version of Landlock knows of these, no device takes orders (ioctl), and no process
// outside is reached by a signal or an abstract socket. What was open before stays usable.
//
// Returns false and changes nothing if the kernel has no Landlock of version 3 (Linux 6.2), the
// first that guards truncate. REQUIRES that no_new_privs is set, and that there is no other
// thread.
bool fence_files(const std::vector<std::string>& folders, bool without_proc);

}  // namespace assay::properties
