// Uses seccomp to keep this process, and what it starts, from some system calls.
#pragma once

namespace assay::properties {

// Holds from now on and for ever. There are no sockets but connected pairs, no tracing of or
// writing into other processes, no namespaces or mounts, no other user, no orders to the kernel,
// and no way around this filter (io_uring). A refused call ends with EPERM, or with ENOSYS if
// programs then fall back to an older call. With `alone` no new processes are made either (threads
// are allowed), and signals reach this process only; that is for a process that shares its world
// with others.
//
// Returns false and changes nothing if the kernel has no seccomp filters. REQUIRES that
// no_new_privs is set.
bool filter_calls(bool alone);

}  // namespace assay::properties
