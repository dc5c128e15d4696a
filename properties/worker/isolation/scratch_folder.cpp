#include "properties/worker/isolation/scratch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

namespace assay::properties {
namespace {

constexpr std::string_view name_begins = "assay-held-";

// Opens and locks a folder of this user. -1 if it is none, or if a process holds it.
int hold(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat seen;
  if (opened >= 0 && ::fstat(opened, &seen) == 0 && seen.st_uid == ::geteuid() &&
      ::flock(opened, LOCK_EX | LOCK_NB) == 0)
    return opened;
  if (opened >= 0) ::close(opened);
  return -1;
}

void clear_those_of_the_dead(const std::filesystem::path& parent) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(parent, error)) {
    if (!entry.path().filename().string().starts_with(name_begins)) continue;
    const int held = hold(entry.path());
    if (held < 0) continue;
    std::filesystem::remove_all(entry.path(), error);
    ::close(held);
  }
}

}  // namespace

Expected<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const auto parent = std::filesystem::temp_directory_path(error);
  if (!error) clear_those_of_the_dead(parent);
  // Another process may clear a new folder before it is held, so this is tried again.
  constexpr int attempts = 10;
  for (int i = 0; !error && i < attempts; ++i) {
    std::string name = (parent / fmt::format("{}XXXXXX", name_begins)).string();
    if (!::mkdtemp(name.data())) error = {errno, std::generic_category()};
    if (const int lock = error ? -1 : hold(name); lock >= 0) {
      ScratchFolder made(name, lock);
      if (std::filesystem::exists(name)) return made;
    }
  }
  return Problem{fmt::format("{}: no folder can be made for temporary files: {}", parent.string(),
                             error ? error.message() : "others remove it")};
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace assay::properties
