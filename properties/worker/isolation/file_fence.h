// Uses Landlock so that this process, and what it starts, writes to no file outside of some
// folders.
#pragma once

#include <string>
#include <vector>

namespace assay::properties {

// Holds from now on and for ever, for the calling thread and all that it starts afterwards. Files
// are opened for writing, made and removed below `folders` alone; /dev/null and its like may be
// written to. Everything may be read and run, except what lies in the folders `unread` (of these,
// only names are seen). What is made later beside such a folder, or beside one above it, is not
// read either. As far as the kernel's version of Landlock knows of these, no device takes orders
// (ioctl), and no process outside is reached by a signal or an abstract socket. What was open
// before stays usable.
//
// Returns false and changes nothing if the kernel has no Landlock of version 3 (Linux 6.2), the
// first that guards truncate. REQUIRES that no_new_privs is set, that `unread` are
// absolute paths without links, and that there is no other thread.
bool fence_files(const std::vector<std::string>& folders, const std::vector<std::string>& unread);

}  // namespace assay::properties
