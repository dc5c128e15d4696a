// The libraries that a library names as needed, as its file says; none of its code runs.
#pragma once

#include <filesystem>
#include <vector>

namespace assay::properties {

// Those that are found by its own paths (RPATH, RUNPATH, $ORIGIN) or by LD_LIBRARY_PATH, those that
// these need in the same way, and so on. Libraries in the system's folders (/lib, /usr/lib, ...)
// are left out. Nothing for a file that is no library of this machine.
std::vector<std::filesystem::path> needed_files(const std::filesystem::path& library);

}  // namespace assay::properties
