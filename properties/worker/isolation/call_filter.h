// Uses seccomp to keep this process, and what it starts, from some system calls.
#pragma once

namespace assay::properties {

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
