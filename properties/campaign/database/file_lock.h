// A lock on a file or a folder that only one process at a time works on.
#pragma once

#include <filesystem>
#include <string>

namespace assay::properties {

// The lock is held until this object or its process ends, however it ends.
class FileLock {
 public:
  enum class On {
    file,    // the file is made if it is not there, and stays
    folder,  // nothing stays of the lock
  };
  // Throws StoreProblem if it cannot be opened, and, with the text `if_busy`, if another process
  // holds it.
  FileLock(const std::filesystem::path& path, On on, const std::string& if_busy);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  int lock_ = -1;
};

}  // namespace assay::properties
