// A folder that is there as long as its object.
#pragma once

#include <filesystem>
#include <utility>

#include "properties/problem.h"

namespace assay::properties {

// A new folder among the system's temporary files, which is removed with this object and all that
// it holds. For a plug-in it is the one place in which it may write, named to it by TMPDIR.
class ScratchFolder {
 public:
  // cannot_write where the system gives none.
  static Expected<ScratchFolder> make();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace assay::properties
