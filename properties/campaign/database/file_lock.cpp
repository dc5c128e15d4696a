#include "properties/campaign/database/file_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "properties/campaign/database/store_problem.h"

namespace assay::properties {

FileLock::FileLock(const std::filesystem::path& path, On on, const std::string& if_busy) {
  const int flags = on == On::file ? O_RDWR | O_CREAT : O_RDONLY | O_DIRECTORY;
  lock_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (lock_ < 0) throw StoreProblem(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(lock_);
  throw StoreProblem(if_busy);
}

FileLock::FileLock(FileLock&& other) noexcept : lock_(std::exchange(other.lock_, -1)) {}
FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(lock_, other.lock_);
  return *this;
}
FileLock::~FileLock() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace assay::properties
