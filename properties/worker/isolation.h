// Isolates the process of a plug-in from everything but its own work.
//
// The isolation assumes that the code of a plug-in can be wrong, crash, hang, fill memory or print,
// and that its author can tune the code to the exam; but the code does not attack this machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "properties/words.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

enum class Isolation : std::uint8_t {
  // A process of its own with limits of time, memory, files and processes.
  limits,
  // The same limits, and the program bwrap: the plug-in has no network, sees no other process, and
  // can write files only in one scratch folder. All processes that it starts end with it.
  bubblewrap,
};
constexpr auto names_of(Isolation) {
  using enum Isolation;
  return std::to_array<Named<Isolation>>({{limits, "limits"}, {bubblewrap, "bubblewrap"}});
}

// Returns the text for people and certificates: "limits alone", "bubblewrap".
constexpr const char* text_of(Isolation isolation) {
  return isolation == Isolation::limits ? "limits alone" : "bubblewrap";
}

// A new folder among the system's temporary files. The destructor removes the folder with its
// files. The folder is the only place where a plug-in may write; TMPDIR has its path.
//
// The process that made the folder holds a lock on it, which the system releases when that process
// ends in any way. make() also removes those scratch folders of this user that have no lock.
class ScratchFolder {
 public:
  // Makes a folder. Fails if the system gives none.
  static Expected<ScratchFolder> make();
  ScratchFolder(ScratchFolder&&) = default;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  ScratchFolder(std::filesystem::path path, Descriptor lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}
  std::filesystem::path path_;
  Descriptor lock_;  // the folder, opened
};

// The output of a plug-in is stored for people to read, case by case. No verdict depends on it.

// The most bytes of the output of one case that are stored. These are the last bytes, because they
// tell how the case ended.
inline constexpr std::size_t longest_printed = 4096;

// Returns the text as printable lines (words.h), without empty ones at the end.
std::string printable_lines(const std::string& text);

// A file in memory that a worker gets in place of stdout and stderr. So a worker that prints never
// waits for a reader, and its lines cannot be mistaken for lines of the host on the terminal.
class PrintedFile {
 public:
  // Returns nothing if the system gives no such file.
  static std::optional<PrintedFile> make();
  int descriptor() const { return file_; }  // at least least_passed_descriptor
  // Shortens a long file to its last part. The host calls this now and then during a case.
  void keep_short();
  // Returns the output since the last call, in printable lines. If it is longer than
  // longest_printed, returns "..." and its last whole lines.
  std::string take();

 private:
  explicit PrintedFile(Descriptor file) : file_(std::move(file)) {}
  void move_to_kept();

  Descriptor file_;
  std::string text_;
  bool is_cut_ = false;
};

// The functions below start a plug-in's worker behind bwrap, the program of bubblewrap.

// Returns in one line why no worker can be started behind bwrap on this machine; empty if bwrap
// works. The first call in a process tries bwrap, because a container may have the program and
// still forbid its work.
const std::string& fault_of_bubblewrap();

// Starts the program like ChildProcess::start, but behind bwrap. The program and its processes can
// write only into the folder `scratch`, which is also their /dev/shm. The child is bwrap. When the
// program ends, bwrap ends too, and its end tells how the program ended (end_behind_bubblewrap).
// When bwrap ends, the program and all its processes end.
Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors);

// Returns how the program behind bwrap ended. Like a shell, bwrap reports signals by exit codes
// above 128.
ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap);

}  // namespace assay::properties
