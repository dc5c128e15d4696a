// The files of a detector that is judged: its library and the libraries that this one needs, or the
// files of a detector in Python. Their digests are taken before the first of its processes loads
// them and after each loading, and at the end: if one of them has changed, because it was built
// anew meanwhile, what was judged is not one detector.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/problem.h"

namespace assay::properties {

class JudgedLibrary {
 public:
  // The library of that name, or the one that serves the detector in Python of that name. As long
  // as somebody in this process keeps it, everybody gets the same.
  static std::shared_ptr<const JudgedLibrary> of(const std::filesystem::path& named,
                                                 const std::filesystem::path& worker);

  // What a worker loads.
  const std::filesystem::path& file() const { return files_.front().path; }

  // SHA-256 of the library's bytes. If it needs libraries outside of the system's folders
  // (needed_files), or is a detector in Python, SHA-256 of the digests of all of these files.
  // Fails, with the reason, if one of them cannot be read.
  const corpus::Expected<std::string>& digest() const { return digest_; }

  // Fails if one of the files is not what it was.
  Expected<void> is_as_it_was() const;

 private:
  JudgedLibrary(const std::filesystem::path& named, const std::filesystem::path& worker);
  void take(const std::vector<std::filesystem::path>& files);

  struct File {
    std::filesystem::path path;
    std::string digest;  // empty if it could not be read
  };

  std::vector<File> files_;  // the library comes first
  corpus::Expected<std::string> digest_;
};

// The libraries that a library names as needed, as its file says; none of its code runs. They are
// those that are found by its own paths (RPATH, RUNPATH, $ORIGIN) or by LD_LIBRARY_PATH, those that
// these need in the same way, and so on. Libraries in the system's folders (/lib, /usr/lib, ...)
// are left out. Nothing for a file that is no library of this machine.
std::vector<std::filesystem::path> needed_files(const std::filesystem::path& library);

}  // namespace assay::properties
