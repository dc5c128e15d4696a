// Linux namespaces: a process that is alone in its world.
#pragma once

namespace assay::properties {

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
