// What a plug-in prints, one case at a time. It is kept for people to read, and nothing is judged
// by it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace assay::properties {

// How many bytes are kept of what is printed in one case: the last ones, because they say how it
// ended.
inline constexpr std::size_t longest_printed = 4096;

// The text as printable lines (printable.h), without empty ones at the end.
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
        kept_(std::move(other.kept_)),
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
  std::string kept_;
  bool is_cut_ = false;
};

}  // namespace assay::properties
