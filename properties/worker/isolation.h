// How far the process of a plug-in is kept away from everything but its own work.
//
// A plug-in is code that may be wrong, crash, hang, fill memory or print, and its author may tune
// it to the exam; it is no enemy that attacks this machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "properties/problem.h"
#include "properties/words.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

enum class Isolation : std::uint8_t {
  // A process of its own with limits of time, memory, files and processes.
  limits,
  // Besides, by the program bwrap: no network, no other process in sight, all that it starts ends
  // with it, and files can only be read, except in one scratch folder.
  bubblewrap,
};
constexpr auto names_of(Isolation) {
  using enum Isolation;
  return std::to_array<Named<Isolation>>({{limits, "limits"}, {bubblewrap, "bubblewrap"}});
}

// As people read it, and as it stands in certificates: "limits alone", "bubblewrap".
constexpr const char* text_of(Isolation isolation) {
  return isolation == Isolation::limits ? "limits alone" : "bubblewrap";
}

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

// What a plug-in prints, one case at a time. It is kept for people to read, and nothing is judged
// by it.

// How many bytes are kept of what is printed in one case: the last ones, because they say how it
// ended.
inline constexpr std::size_t longest_printed = 4096;

// The text as printable lines (words.h), without empty ones at the end.
std::string printable_lines(const std::string& text);

// A file in memory that a worker is started with in place of stdout and stderr. So nobody who
// prints waits for a reader, and no line on the terminal of the user can be taken for one of the
// host.
class PrintedFile {
 public:
  // Nothing if the system gives none.
  static std::optional<PrintedFile> make();
  PrintedFile(PrintedFile&& other) noexcept
      : file_(std::exchange(other.file_, -1)),
        text_(std::move(other.text_)),
        is_cut_(other.is_cut_) {}
  PrintedFile& operator=(PrintedFile&&) = delete;
  ~PrintedFile();

  int descriptor() const { return file_; }  // at least least_passed_descriptor
  // Empties the file down to its end if it is long; to be called now and then in a case.
  void keep_short();
  // What came since the last call, in printable lines: the end of it, from a whole line on behind
  // "...", if it is longer than longest_printed.
  std::string take();

 private:
  explicit PrintedFile(int file) : file_(file) {}
  void move_to_kept();

  int file_;
  std::string text_;
  bool is_cut_ = false;
};

// The program bwrap of bubblewrap, behind which a plug-in's worker is started.

// Why no worker can be started behind bwrap on this machine, in one line; empty if it works. It is
// tried once in a process: a container may hold the program and forbid what it does.
const std::string& fault_of_bubblewrap();

// Starts the program behind bwrap, as ChildProcess::start does. It and what it starts write into
// the folder `scratch` alone, which is /dev/shm too. The child is bwrap, which ends as the program
// does (end_behind_bubblewrap), and ends the program and all that it started when it ends itself.
Expected<ChildProcess> start_behind_bubblewrap(const std::filesystem::path& program,
                                               const std::vector<std::string>& arguments,
                                               const std::filesystem::path& scratch,
                                               std::vector<PassedDescriptor> descriptors);

// How the program ended. bwrap tells a signal as a shell does, by an exit code of 128 and more.
ChildEnd end_behind_bubblewrap(const ChildEnd& of_bwrap);

}  // namespace assay::properties
