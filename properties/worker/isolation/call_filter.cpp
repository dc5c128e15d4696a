#include "properties/worker/isolation/call_filter.h"

#include <sched.h>
#include <seccomp.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

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
    const int call = ::seccomp_syscall_resolve_name(name);
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
    "ptrace",
    "process_vm_readv",
    "process_vm_writev",
    "process_madvise",
    "process_mrelease",
    "pidfd_open",
    "pidfd_getfd",
    "pidfd_send_signal",
    "kcmp",
    "move_pages",
    "migrate_pages",
    // Calls that change who the process is.
    "setuid",
    "setreuid",
    "setresuid",
    "setuid32",
    "setreuid32",
    "setresuid32",
    // Calls that reach the world around the process.
    "socket",
    "connect",
    "bind",
    "unshare",
    "setns",
    "mount",
    "umount2",
    "pivot_root",
    "chroot",
    "open_tree",
    "move_mount",
    "fsopen",
    "fsconfig",
    "fsmount",
    "fspick",
    "mount_setattr",
    "name_to_handle_at",
    "open_by_handle_at",
    "quotactl",
    "quotactl_fd",
    "acct",
    "swapon",
    "swapoff",
    "reboot",
    "kexec_load",
    "kexec_file_load",
    "init_module",
    "finit_module",
    "delete_module",
    "bpf",
    "perf_event_open",
    "userfaultfd",
    "fanotify_init",
    "keyctl",
    "add_key",
    "request_key",
    "syslog",
    "settimeofday",
    "clock_settime",
    "clock_adjtime",
    "adjtimex",
    "sethostname",
    "setdomainname",
    "iopl",
    "ioperm",
    "mknod",
    "mknodat",
    "vhangup",
    "lookup_dcookie",
};

}  // namespace

bool filter_calls(bool alone) {
  Filter filter;
  for (const char* name : forbidden) filter.refuse(name, EPERM);
  for (const char* name : {"io_uring_setup", "io_uring_enter", "io_uring_register"}) {
    filter.refuse(name, ENOSYS);
  }
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
  }
  return filter.load();
}

}  // namespace assay::properties
