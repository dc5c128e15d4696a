// A folder that exists as long as its object.
#pragma once

#include <filesystem>
#include <utility>

#include "properties/problem.h"

namespace assay::properties {

// A new folder among the system's temporary files. It is removed with this object, and so is all
// that it holds. It is the only place in which a plug-in may write; TMPDIR names it to the
// plug-in.
//
// The process that made it holds a lock on it, which the system takes away when that process ends,
// however that may be. Whoever makes a folder clears those of this user that nobody holds any more.
class ScratchFolder {
 public:
  // Fails if the system gives none.
  static Expected<ScratchFolder> make();
  ScratchFolder(ScratchFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}
  ScratchFolder& operator=(ScratchFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(lock_, other.lock_);
    return *this;
  }
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  ScratchFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::filesystem::path path_;
  int lock_ = -1;  // the folder, opened
};

}  // namespace assay::properties
