// The one file that is judged, whatever is built in its place meanwhile.
//
// The files of a detector are copied once, to a folder of this process in which nobody else
// writes: its library and the libraries that this one needs, or the files of a detector in Python.
// In the world of an isolated plug-in the copies lie where the originals lie outside of it. So
// whatever the plug-in finds from its own place, it finds as before.
//
// Where there is no such world, the originals themselves are loaded. They are looked at after each
// loading and at the end: if one of them has changed, what was judged is not one file.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/problem.h"
#include "properties/worker/isolation/scratch_folder.h"

namespace assay::properties {

class JudgedLibrary {
 public:
  // The library of that name, or the one that serves the detector in Python of that name. As long
  // as somebody in this process keeps it, everybody gets the same.
  static std::shared_ptr<const JudgedLibrary> of(const std::filesystem::path& named,
                                                 const std::filesystem::path& worker);

  // What a worker loads.
  const std::filesystem::path& file() const { return files_.front().original; }

  struct File {
    std::filesystem::path original, copy;  // no copy, if none could be made
    std::string digest;
  };
  // The library comes first.
  const std::vector<File>& files() const { return files_; }

  // SHA-256 of the library's bytes. If it needs libraries outside of the system's folders
  // (needed_files), or is a detector in Python, SHA-256 of the digests of all of these files.
  // Fails, with the reason, if one of them cannot be read.
  const corpus::Expected<std::string>& digest() const { return digest_; }

  // A worker has loaded the originals, because it has no world of its own.
  void note_loaded_in_place() const { is_loaded_in_place_ = true; }
  // Fails if originals were loaded and one of them is not what it was.
  Expected<void> is_as_it_was() const;

 private:
  JudgedLibrary(const std::filesystem::path& named, const std::filesystem::path& worker);
  void take(const std::vector<std::filesystem::path>& files);

  std::optional<ScratchFolder> folder_;
  std::vector<File> files_;
  corpus::Expected<std::string> digest_;
  mutable std::atomic<bool> is_loaded_in_place_ = false;
};

// The libraries that a library names as needed, as its file says; none of its code runs. They are
// those that are found by its own paths (RPATH, RUNPATH, $ORIGIN) or by LD_LIBRARY_PATH, those that
// these need in the same way, and so on. Libraries in the system's folders (/lib, /usr/lib, ...)
// are left out. Nothing for a file that is no library of this machine.
std::vector<std::filesystem::path> needed_files(const std::filesystem::path& library);

}  // namespace assay::properties
