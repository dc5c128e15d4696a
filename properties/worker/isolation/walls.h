// The walls around the process of a plug-in, each with what Linux offers for it: namespaces, in
// which it is alone; a limit on its memory; Landlock, so that it writes to no file outside of some
// folders; and seccomp, which keeps it from some system calls (call_filter.cpp).
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

// Limits the bytes of address space of this process and of each process that it starts; 0: no
// limit. A lower limit that the user has set stays. False if the system refuses.
bool limit_memory(std::uint64_t bytes);

// If the machine itself runs out of memory, the system ends this process, and what it starts,
// before any other. Many processes together may take more than the machine has, although each
// keeps its limit.
void end_first_without_memory();

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

// Holds from now on and for ever. There are no sockets but connected pairs, no tracing of or
// writing into other processes, no namespaces or mounts, no other user, no orders to the kernel,
// and no way around this filter (io_uring). No file changes its mode, owner, times, attributes or
// flags, and none is locked or leased. This holds in the scratch folder too, because a filter sees
// no paths. Memory that no limit would count is not given: files without a folder (memfd_create)
// and the shared memory and queues of System V. A refused call ends with EPERM, or with what a
// system without that call answers, if programs then do without.
//
// With `alone` no new processes are made either (threads are allowed), and signals and priorities
// reach this process only; that is for a process that shares its world with others.
//
// The calls of another form of the processor (i386, x32) are not known here. They end the process.
//
// Returns false and changes nothing if the kernel has no seccomp filters. REQUIRES that
// no_new_privs is set.
bool filter_calls(bool alone);

}  // namespace assay::properties
