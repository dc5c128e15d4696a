// Linux namespaces: a process that is alone in its world.
#pragma once

namespace assay::properties {

// What a limit on the number of processes (RLIMIT_NPROC) holds for from now on: the system exempts
// the user root from it, by the real user of a process. Where that is root, it becomes another one;
// as whom files are opened and what may be done stays as it is. The call filter keeps the way back
// shut. REQUIRES that this process has one thread.
void become_limitable();

// The next process that this one starts is the first of a new world of processes: what begins
// there sees no other process, and ends with the first. This process gets a view of the file
// system of its own, and that world no network. False, and nothing is changed, where the system
// does not allow it. REQUIRES that this process has one thread.
bool begin_new_world();

// Where POSIX shared memory lies.
inline constexpr const char* shared_memory = "/dev/shm";

// For the first process of the new world: /proc shows that world alone, and shared memory is its
// own. Where the system forbids that, /proc is empty. False where neither can be had, and /proc
// shows the old world.
bool show_new_world();

// This process has no special rights any more, not even over its own namespaces.
bool drop_capabilities();

}  // namespace assay::properties
