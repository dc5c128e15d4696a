// A file or a folder that one process at a time works on.
#pragma once

#include <filesystem>
#include <string>

namespace assay::properties {

// Held until this object or its process ends, however it ends.
class FileLock {
 public:
  enum class On {
    file,    // made where it is not there, and left there
    folder,  // nothing is left of the lock
  };
  // Throws StoreProblem: busy, with the line that is given, where another process holds it;
  // cannot_write where it cannot be opened.
  FileLock(const std::filesystem::path& path, On on, const std::string& if_busy);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  int lock_ = -1;
};

}  // namespace assay::properties
