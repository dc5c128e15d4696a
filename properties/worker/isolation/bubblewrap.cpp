#include "properties/worker/isolation/bubblewrap.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>

#include "properties/worker/isolation/printed_words.h"

namespace assay::properties {
namespace {

// The number by which bwrap finds the filter of calls.
constexpr int filter_descriptor = 5;

// Calls that ask for a network, and those that give memory which no limit counts. Programs do
// without, as on a system that does not have them.
constexpr const char* refused_calls[] = {
    "socket", "io_uring_setup", "memfd_create", "memfd_secret", "shmget", "msgget", "mq_open",
};

// An open file in memory that holds the filter; -1 if the system gives none.
int open_filter() {
  const int file = ::memfd_create("filter", MFD_CLOEXEC);
  const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ALLOW);
  bool is_whole = file >= 0 && filter != nullptr;
  for (const char* name : refused_calls) {
    // A call that the processor of this machine does not have is passed over.
    const int call = ::seccomp_syscall_resolve_name(name);
    if (call < 0) continue;
    is_whole = is_whole && ::seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), call, 0) == 0;
  }
  is_whole = is_whole && ::seccomp_export_bpf(filter, file) == 0 && ::lseek(file, 0, SEEK_SET) == 0;
  if (filter) ::seccomp_release(filter);
  const int high = is_whole ? ::fcntl(file, F_DUPFD_CLOEXEC, least_passed_descriptor) : -1;
  if (file >= 0) ::close(file);
  return high;
}

std::string try_bubblewrap() {
  auto printed = PrintedFile::make();
  if (!printed) return "the system gives no file in memory";
  auto child = start_behind_bubblewrap("true", {}, {}, {{printed->descriptor(), STDERR_FILENO}});
  if (!child) return child.error().message;
  // It takes a tenth of a second. A machine under load must not be taken for one that forbids it.
  constexpr std::chrono::minutes patience{5};
  const ChildEnd end = child.value().finish(patience);
  if (end.signal == 0 && end.code == 0) return "";
  const std::string said = printed->take();
  return said.empty() ? "bwrap " + end.text : said.substr(said.rfind('\n') + 1);
}

}  // namespace

const std::string& fault_of_bubblewrap() {
  static const std::string fault = try_bubblewrap();
  return fault;
}

Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors) {
  std::vector<std::string> words = {"--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc"};
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
  };
  // Some libraries count their threads in shared memory.
  if (!scratch.empty()) add({"--bind", scratch, scratch, "--bind", scratch, "/dev/shm"});
  add({"--remount-ro", "/dev", "--unshare-pid", "--unshare-net", "--unshare-ipc",
       "--die-with-parent"});
  // Root keeps no right but the one that lets a limit on processes hold for it (own_limits.h).
  if (::getuid() == 0) add({"--cap-drop", "ALL", "--cap-add", "CAP_SETUID"});
  const int filter = open_filter();
  if (filter < 0) return Problem{"no filter of system calls for bwrap"};
  descriptors.push_back({filter, filter_descriptor});
  add({"--seccomp", std::to_string(filter_descriptor), "--", program});
  words.insert(words.end(), arguments.begin(), arguments.end());
  auto child = ChildProcess::start("bwrap", words, descriptors);
  ::close(filter);
  return child;
}

ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap) {
  constexpr int first_of_signals = 128, last_of_signals = 128 + 64;
  if (of_bwrap.signal != 0 || of_bwrap.code <= first_of_signals || of_bwrap.code > last_of_signals)
    return of_bwrap;
  return end_by_signal(of_bwrap.code - first_of_signals);
}

}  // namespace assay::properties
