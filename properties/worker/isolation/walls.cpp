#include "properties/worker/isolation/walls.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/landlock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

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

bool limit_memory(std::uint64_t bytes) {
  rlimit limit = {};
  if (bytes == 0) return true;
  if (::getrlimit(RLIMIT_AS, &limit) != 0) return false;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, bytes);
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, bytes);
  return ::setrlimit(RLIMIT_AS, &limit) == 0;
}

// If the system has no such file, or keeps it closed, it chooses by itself which process to end.
void end_first_without_memory() {
  constexpr std::string_view first_of_all = "1000";
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const auto written = ::write(file, first_of_all.data(), first_of_all.size());
  ::close(file);
}

namespace {

// The headers of a system may be older than its kernel. So the rights that they may not name yet
// stand here.
constexpr std::uint64_t truncate_right = 1ULL << 14;  // from version 3 of Landlock on
constexpr std::uint64_t ioctl_right = 1ULL << 15;     // from version 5 of Landlock on
constexpr std::uint64_t read_rights =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t write_rights =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
    LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
    LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
    LANDLOCK_ACCESS_FS_MAKE_SYM | (1ULL << 13) /* REFER */;
constexpr std::uint64_t rights_of_files = LANDLOCK_ACCESS_FS_EXECUTE |
                                          LANDLOCK_ACCESS_FS_READ_FILE |
                                          LANDLOCK_ACCESS_FS_WRITE_FILE | truncate_right;

struct Rules {
  std::uint64_t files = 0, network = 0, scopes = 0;
};

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

// A path that does not exist needs no rule.
bool allow(int rules, const std::string& path, std::uint64_t rights) {
  const Descriptor place(::open(path.c_str(), O_PATH | O_CLOEXEC));
  if (place.number() < 0) return true;
  struct stat seen;
  if (::fstat(place.number(), &seen) != 0) return false;
  if (!S_ISDIR(seen.st_mode)) rights &= rights_of_files;
  landlock_path_beneath_attr rule = {rights, place.number()};
  return ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
}

// Landlock has no exceptions from a rule, so all that lies beside an unread folder, and beside the
// folders above it, gets a rule of its own. Links are passed over, because they may lead there.
bool allow_reading(int rules, const std::string& folder, const std::vector<std::string>& unread) {
  if (std::find(unread.begin(), unread.end(), folder) != unread.end()) return true;
  const std::string below = folder == "/" ? folder : folder + "/";
  const bool has_unread = std::any_of(unread.begin(), unread.end(), [&](const std::string& other) {
    return other.starts_with(below);
  });
  if (!has_unread) return allow(rules, folder, read_rights);
  // Python looks for a module by listing the folder.
  if (folder != "/" && !allow(rules, folder, LANDLOCK_ACCESS_FS_READ_DIR)) return false;
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  if (!open) return true;  // nothing in there can be read anyway
  while (const dirent* entry = ::readdir(open.get())) {
    const std::string name = entry->d_name;
    struct stat seen;
    if (name == "." || name == ".." || ::lstat((below + name).c_str(), &seen) != 0) continue;
    if (!S_ISLNK(seen.st_mode) && !allow_reading(rules, below + name, unread)) return false;
  }
  return true;
}

}  // namespace

bool fence_files(const std::vector<std::string>& folders, const std::vector<std::string>& unread) {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, 1U /* its version */);
  constexpr long guards_truncate = 3, guards_ioctl = 5, has_scopes = 6;
  if (version < guards_truncate) return false;
  Rules wanted;
  wanted.files = read_rights | write_rights | truncate_right;
  std::size_t size = sizeof wanted.files;
  if (version >= guards_ioctl) wanted.files |= ioctl_right;
  if (version >= has_scopes) {
    wanted.scopes = 1ULL /* abstract sockets */ | 2ULL /* signals */;
    size = sizeof wanted;
  }
  const Descriptor rules(
      static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, size, 0)));
  if (rules.number() < 0) return false;
  if (!allow_reading(rules.number(), "/", unread)) return false;
  for (const auto& folder : folders) {
    if (!allow(rules.number(), folder, read_rights | write_rights | truncate_right)) return false;
  }
  for (const char* sink : {"/dev/null", "/dev/zero", "/dev/full"}) {
    if (!allow(rules.number(), sink, LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE))
      return false;
  }
  return ::syscall(SYS_landlock_restrict_self, rules.number(), 0) == 0;
}

}  // namespace assay::properties
