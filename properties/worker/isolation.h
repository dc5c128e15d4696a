// Isolates the process of a plug-in from everything but its own work.
//
// The code of a plug-in may be wrong, crash, hang, fill memory or print, and its author may tune it
// to the exam; but it is no enemy that attacks this machine.
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
  // In addition, by the program bwrap: no network, no other process in sight, all processes that it
  // starts end with it, and files can only be read, except in one scratch folder.
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

// A new folder among the system's temporary files. It is removed with this object, together with
// its files. It is the only place in which a plug-in may write; TMPDIR names it to the plug-in.
//
// The process that made the folder holds a lock on it, which the system releases when that process
// ends in any way. Making a folder removes those folders of this user that nobody locks any more.
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

// Keeps the output of a plug-in, one case at a time, for people to read. Nothing is judged by it.

// How many bytes of the output of one case are kept: the last ones, because they say how it ended.
inline constexpr std::size_t longest_printed = 4096;

// Returns the text as printable lines (words.h), without empty ones at the end.
std::string printable_lines(const std::string& text);

// A file in memory that a worker gets in place of stdout and stderr. So printing never waits for a
// reader, and no line on the user's terminal can be mistaken for one of the host.
class PrintedFile {
 public:
  // Returns nothing if the system gives no such file.
  static std::optional<PrintedFile> make();
  int descriptor() const { return file_; }  // at least least_passed_descriptor
  // Shortens a long file to its last part; to be called now and then in a case.
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

// Starts a plug-in's worker behind bwrap, the program of bubblewrap.

// Returns why no worker can be started behind bwrap on this machine, in one line; empty if it
// works. bwrap is tried once in a process, because a container may have the program and yet forbid
// its work.
const std::string& fault_of_bubblewrap();

// Starts the program behind bwrap, as ChildProcess::start does. The program and its processes can
// write only into the folder `scratch`, which is also their /dev/shm. The child is bwrap, which
// ends as the program does (end_behind_bubblewrap). If bwrap ends, it ends the program and all its
// processes.
Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors);

// Returns how the program ended. bwrap reports signals as a shell does, by exit codes from 128 on.
ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap);

}  // namespace assay::properties
