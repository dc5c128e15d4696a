#include "properties/worker/isolation/file_fence.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace assay::properties {
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
