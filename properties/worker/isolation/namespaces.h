// Puts a process into Linux namespaces, in which it is alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "properties/worker/isolation/keeper.h"

namespace assay::properties {

// Makes a limit on the number of processes (RLIMIT_NPROC) hold for this process from now on. The
// system exempts the user root from it, by the real user of a process. So if that is root, it
// becomes another user; as whom files are opened, and what may be done, stays as it is. The call
// filter keeps the way back shut. REQUIRES that this process has one thread.
void become_limitable();

// After this call, the next process that this one starts is the first of a new world of processes:
// what begins there sees no other process, and ends with the first. This process gets a view of
// the file system of its own, and that world has no network. If the system does not allow it,
// returns false and changes nothing. REQUIRES that this process has one thread.
bool begin_new_world();

// The folder in which POSIX shared memory lies.
inline constexpr const char* shared_memory = "/dev/shm";

// For the first process of the new world. After this call /proc shows that world alone. If the
// system forbids that, /proc is empty. Shared memory and the folder `scratch` are that world's own:
// one folder in memory that holds at most `bytes` bytes (0: what the system allows). Returns false
// if /proc shows the old world.
bool show_new_world(const std::string& scratch, std::uint64_t bytes);

// In the new world alone, each copy is from now on what lies at the path of its original. False if
// that cannot be had of all.
bool replace_files(const std::vector<ReplacedFile>& files);

// Takes away all special rights of this process, even those over its own namespaces.
bool drop_capabilities();

}  // namespace assay::properties
