// A folder that exists as long as its object.
#pragma once

#include <filesystem>
#include <utility>

#include "properties/problem.h"

namespace assay::properties {

// A new folder among the system's temporary files. It is removed with this object, and so is all
// that it holds. It is the only place in which a plug-in may write; TMPDIR names it to the
// plug-in.
class ScratchFolder {
 public:
  // Fails with cannot_write if the system gives none.
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
