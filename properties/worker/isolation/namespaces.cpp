#include "properties/worker/isolation/namespaces.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>

namespace assay::properties {
namespace {

bool write_to(const char* path, const std::string& text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  return written;
}

bool enter() {
  const std::string user = std::to_string(::geteuid()), group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNS | CLONE_NEWIPC | CLONE_NEWNET) != 0) {
    return false;
  }
  // In the new namespace the process stays the same user, and there is no other user.
  return write_to("/proc/self/setgroups", "deny") &&
         write_to("/proc/self/uid_map", user + " " + user + " 1") &&
         write_to("/proc/self/gid_map", group + " " + group + " 1");
}

// If an attempt fails half way there is no way back, so another process tries it first.
bool is_allowed() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(enter() ? 0 : 1);
  int status = 1;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return child > 0 && status == 0;
}

// The user "nobody", by convention.
constexpr uid_t not_root = 65534;

}  // namespace

void become_limitable() {
  // The call is refused if that user is not known. That is so in a namespace in which root is not
  // the root of the system either, and so is not exempt from limits.
  constexpr auto as_it_is = static_cast<uid_t>(-1);
  if (::getuid() == 0) (void)!::setresuid(not_root, as_it_is, as_it_is);
}

bool begin_new_world() { return is_allowed() && enter(); }

bool show_new_world(const std::string& scratch, std::uint64_t bytes) {
  // From now on mounts are not visible outside.
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  constexpr unsigned long flags = MS_NOSUID | MS_NODEV;
  // Some libraries count their threads in shared memory. It is the same folder as the scratch
  // folder, so that one limit holds for both.
  const std::string options =
      "mode=0700" + (bytes > 0 ? ",size=" + std::to_string(bytes) : std::string());
  if (::mount("scratch", scratch.c_str(), "tmpfs", flags, options.c_str()) == 0)
    ::mount(scratch.c_str(), shared_memory, nullptr, MS_BIND, nullptr);
  return ::mount("proc", "/proc", "proc", flags | MS_NOEXEC, nullptr) == 0 ||
         ::mount("none", "/proc", "tmpfs", flags | MS_NOEXEC | MS_RDONLY, nullptr) == 0;
}

bool replace_files(const std::vector<ReplacedFile>& files) {
  return std::all_of(files.begin(), files.end(), [](const ReplacedFile& file) {
    return ::mount(file.copy.c_str(), file.original.c_str(), nullptr, MS_BIND, nullptr) == 0;
  });
}

bool drop_capabilities() {
  for (int right = 0; ::prctl(PR_CAPBSET_READ, right, 0, 0, 0) >= 0; ++right) {
    ::prctl(PR_CAPBSET_DROP, right, 0, 0, 0);  // a right that may not be dropped is not there
  }
  ::prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none = {};
  return ::syscall(SYS_capset, &header, none.data()) == 0;
}

}  // namespace assay::properties
