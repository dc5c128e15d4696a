#include "corpus/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace assay::corpus {
namespace {

Problem refused(const std::filesystem::path& path, int error) {
  return problem_in(path, fmt::format("cannot be written: {}", std::strerror(error)));
}

// The file that is written and then becomes `path`: NAME.part, or NAME.1.part while another writer
// has that, and so on. Its writer holds a lock on it that ends with the process, so the next
// writer can take what a killed one left.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path) {
    constexpr int most_writers = 1000;
    for (int n = 0; n < most_writers && file_ < 0; ++n) {
      name_ = path;
      name_ += n == 0 ? ".part" : fmt::format(".{}.part", n);
      while (take() == Taken::again) {
      }
      if (file_ < 0 && error_ != EWOULDBLOCK) return;
    }
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  // Removes the part, unless it has become the file.
  ~PartFile() {
    if (file_ < 0) return;
    if (!has_become_) ::unlink(name_.c_str());
    ::close(file_);
  }

  // Each of these gives 0, or the error number of the first call that failed.
  int error() const { return file_ < 0 ? error_ : 0; }
  int write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    // A full disk may show only when a file is closed. This one stays open for its lock, so a
    // duplicate is closed.
    const int again = ::fcntl(file_, F_DUPFD_CLOEXEC, 0);
    return again < 0 || ::close(again) != 0 ? errno : 0;
  }
  int become(const std::filesystem::path& path) {
    if (std::rename(name_.c_str(), path.c_str()) != 0) return errno;
    has_become_ = true;
    return 0;
  }

 private:
  enum class Taken { yes, no, again };

  // Opens the file that has the name, locks it and empties it.
  Taken take() {
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (file_ < 0) return fail(errno);
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) return fail(errno);
    // Its writer may have renamed or removed it before it was locked here.
    struct stat opened, there;
    if (::fstat(file_, &opened) != 0) return fail(errno);
    if (::stat(name_.c_str(), &there) != 0 || opened.st_ino != there.st_ino ||
        opened.st_dev != there.st_dev) {
      fail(EWOULDBLOCK);
      return Taken::again;
    }
    return ::ftruncate(file_, 0) == 0 ? Taken::yes : fail(errno);
  }
  Taken fail(int error) {
    if (const int file = std::exchange(file_, -1); file >= 0) ::close(file);
    error_ = error;
    return Taken::no;
  }

  std::filesystem::path name_;
  int file_ = -1;
  int error_ = 0;
  bool has_become_ = false;
};

}  // namespace

Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  PartFile part(path);
  int error = part.error();
  if (error == 0) error = part.write(bytes);
  if (error == 0) error = part.become(path);
  if (error != 0) return refused(path, error);
  return boost::outcome_v2::success();
}

}  // namespace assay::corpus
