#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <memory>

#include "properties/worker/isolation/walls.h"

namespace assay::properties {
namespace {

class Filter {
 public:
  Filter() : context_(::seccomp_init(SCMP_ACT_ALLOW), ::seccomp_release) {
    ok_ = context_ != nullptr;
    // no_new_privs must have been set by the caller. Setting it here would hide that a caller
    // forgot to.
    if (ok_) ::seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_NNP, 0);
  }

  // A call that the processor of this machine does not have is passed over.
  template <class... Condition>
  void refuse(const char* name, int error, Condition... condition) {
    refuse(::seccomp_syscall_resolve_name(name), error, condition...);
  }
  template <class... Condition>
  void refuse(int call, int error, Condition... condition) {
    if (!ok_ || call < 0) return;
    ok_ = ::seccomp_rule_add(context_.get(), SCMP_ACT_ERRNO(static_cast<unsigned>(error)), call,
                             sizeof...(condition), condition...) == 0;
  }
  bool load() { return ok_ && ::seccomp_load(context_.get()) == 0; }

 private:
  std::unique_ptr<void, void (*)(scmp_filter_ctx)> context_;
  bool ok_ = false;
};

constexpr const char* forbidden[] = {
    // Calls that reach other processes.
    "ptrace", "process_vm_readv", "process_vm_writev", "process_madvise", "process_mrelease",
    "pidfd_open", "pidfd_getfd", "pidfd_send_signal", "kcmp", "move_pages", "migrate_pages",
    // Calls that change who the process is.
    "setuid", "setreuid", "setresuid", "setuid32", "setreuid32", "setresuid32",
    // Calls that reach the world around the process.
    "socket", "connect", "bind", "unshare", "setns", "mount", "umount2", "pivot_root", "chroot",
    "open_tree", "move_mount", "fsopen", "fsconfig", "fsmount", "fspick", "mount_setattr",
    "name_to_handle_at", "open_by_handle_at", "quotactl", "quotactl_fd", "acct", "swapon",
    "swapoff", "reboot", "kexec_load", "kexec_file_load", "init_module", "finit_module",
    "delete_module", "bpf", "perf_event_open", "userfaultfd", "fanotify_init", "keyctl", "add_key",
    "request_key", "syslog", "settimeofday", "clock_settime", "clock_adjtime", "adjtimex",
    "sethostname", "setdomainname", "iopl", "ioperm", "mknod", "mknodat", "vhangup",
    "lookup_dcookie",
    // Calls that change what a file is, but not what it holds. Landlock does not guard these.
    "chmod", "fchmod", "fchmodat", "chown", "fchown", "lchown", "fchownat", "setxattr", "lsetxattr",
    "fsetxattr", "removexattr", "lremovexattr", "fremovexattr", "utime", "utimes", "futimesat",
    "utimensat", "flock"};

// Calls of the same kind that are younger than the library of filters may be. Their numbers are
// the same for every processor.
constexpr int forbidden_numbers[] = {
    452,  // fchmodat2
    463,  // setxattrat
    466,  // removexattrat
    467,  // open_tree_attr
    469,  // file_setattr
};

// What is not there, so that programs do without it.
constexpr const char* missing[] = {
    "io_uring_setup", "io_uring_enter", "io_uring_register",
    "memfd_create",   "memfd_secret",   "shmget",
    "shmat",          "shmctl",         "semget",
    "semop",          "semtimedop",     "semctl",
    "msgget",         "msgsnd",         "msgrcv",
    "msgctl",         "mq_open",        "mq_unlink",
};

// The system looks at the lower half of these arguments only.
constexpr scmp_datum_t lower_half = 0xffffffff;

// Locks, leases, and hints that stay with a file (the headers may be older than some).
constexpr scmp_datum_t forbidden_fcntls[] = {
    F_SETLK, F_SETLKW,
    37,    // F_OFD_SETLK
    38,    // F_OFD_SETLKW
    1024,  // F_SETLEASE
    1036,  // F_SET_RW_HINT
    1038,  // F_SET_FILE_RW_HINT
    1040,  // F_SETDELEG
};

// Orders to files and terminals (ioctl). Only these harmless ones are let through; they have a
// high byte in common. Others change flags of files, seal them, or tell a terminal what was typed.
constexpr scmp_datum_t allowed_orders[] = {TCGETS,  TIOCGPGRP, TIOCGWINSZ, FIONREAD,
                                           FIONBIO, FIONCLEX,  FIOCLEX};

void refuse_orders(Filter& filter) {
  constexpr scmp_datum_t high_byte = 0x5400, low_byte = 0xff;
  for (scmp_datum_t bit = low_byte + 1; bit <= lower_half; bit <<= 1)
    filter.refuse("ioctl", ENOTTY, SCMP_A1(SCMP_CMP_MASKED_EQ, bit, ~high_byte & bit));
  for (scmp_datum_t low = 0; low <= low_byte; ++low) {
    const bool is_allowed = std::find(std::begin(allowed_orders), std::end(allowed_orders),
                                      high_byte | low) != std::end(allowed_orders);
    if (!is_allowed) filter.refuse("ioctl", ENOTTY, SCMP_A1(SCMP_CMP_MASKED_EQ, low_byte, low));
  }
}

}  // namespace

bool filter_calls(bool alone) {
  Filter filter;
  for (const char* name : forbidden) filter.refuse(name, EPERM);
  for (const int number : forbidden_numbers) filter.refuse(number, EPERM);
  for (const char* name : missing) filter.refuse(name, ENOSYS);
  for (const scmp_datum_t order : forbidden_fcntls)
    filter.refuse("fcntl", EPERM, SCMP_A1(SCMP_CMP_MASKED_EQ, lower_half, order));
  refuse_orders(filter);
  // Calls that make new namespaces. clone3 hides its flags from a filter, so it is refused as a
  // whole; the C library then uses clone.
  filter.refuse("clone3", ENOSYS);
  for (const scmp_datum_t flag : {CLONE_NEWUSER, CLONE_NEWPID, CLONE_NEWNS, CLONE_NEWNET,
                                  CLONE_NEWIPC, CLONE_NEWUTS, CLONE_NEWCGROUP}) {
    filter.refuse("clone", EPERM, SCMP_A0(SCMP_CMP_MASKED_EQ, flag, flag));
  }
  if (alone) {
    filter.refuse("fork", EPERM);
    filter.refuse("vfork", EPERM);
    filter.refuse("clone", EPERM, SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0));
    const auto self = static_cast<scmp_datum_t>(::getpid());
    for (const char* name : {"kill", "tgkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo"}) {
      filter.refuse(name, EPERM, SCMP_A0(SCMP_CMP_NE, self));
    }
    filter.refuse("tkill", EPERM);
    // 0 names the calling thread, which may do this to itself only. So pinning another thread is
    // refused too.
    for (const char* name : {"prlimit64", "sched_setaffinity", "sched_setscheduler",
                             "sched_setparam", "sched_setattr"}) {
      filter.refuse(name, EPERM, SCMP_A0(SCMP_CMP_NE, 0));
    }
    for (const char* name : {"setpriority", "ioprio_set"}) filter.refuse(name, EPERM);
    for (const scmp_datum_t receiver : {8 /* F_SETOWN */, 15 /* F_SETOWN_EX */})
      filter.refuse("fcntl", EPERM, SCMP_A1(SCMP_CMP_MASKED_EQ, lower_half, receiver));
  }
  return filter.load();
}

}  // namespace assay::properties
