// Uses Landlock so that this process, and what it starts, writes to no file outside of some
// folders.
#pragma once

#include <string>
#include <vector>

namespace assay::properties {

// Holds from now on and for ever. Files are made, changed and removed below `folders` alone;
// /dev/null and its like may be written to. Everything may be read and run, except /proc if
// `without_proc`. No device takes orders (ioctl), and no process outside is reached by a signal or
// an abstract socket, as far as the kernel's version of Landlock knows of these.
//
// Returns false and changes nothing if the kernel has no Landlock of version 3 (Linux 6.2), the
// first that guards truncate. REQUIRES that no_new_privs is set.
bool fence_files(const std::vector<std::string>& folders, bool without_proc);

}  // namespace assay::properties
