// seccomp: system calls that this process, and what it starts, does not get to make.
#pragma once

namespace assay::properties {

// From now on, and for ever: no sockets but connected pairs, no tracing of or writing into other
// processes, no namespaces or mounts, no other user, no orders to the kernel, and no way around
// this filter (io_uring). A call that is refused ends with EPERM, or with ENOSYS where a program
// then falls back to an older call. With `alone` no new processes either (threads are allowed), and
// signals to this process only: for where it shares its world with others. False, and nothing is
// changed, where the kernel has no seccomp filters. REQUIRES that no_new_privs is set.
bool filter_calls(bool alone);

}  // namespace assay::properties
