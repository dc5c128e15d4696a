// What a plug-in prints, on its way from its process over the keeper to the host, one case at a
// time. It is kept for people to read, and nothing is judged by it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace assay::properties {

// How many bytes are kept of what is printed in one case: the last ones, because they say how it
// ended.
inline constexpr std::size_t longest_printed = 4096;

// Keeps the end of a text that grows. If its beginning is lost, what is kept begins with "..." and
// a whole line.
class LastWords {
 public:
  void add(const char* bytes, std::size_t size);
  bool empty() const { return kept_.empty(); }
  std::string take();

 private:
  std::string kept_;
  bool is_cut_ = false;
};

// Reads what there is to read from a descriptor that does not wait, at most 1 MB a call. False if
// nobody can write to it any more.
bool read_what_is_there(int descriptor, LastWords& words);

// The text as printable lines (printable.h), without empty ones at the end.
std::string printable_lines(const std::string& text);

// A pipe: the host's end, and the end with which its worker is started.
class PrintedPipe {
 public:
  // Nothing if the system has no more descriptors.
  static std::optional<PrintedPipe> make();
  PrintedPipe(PrintedPipe&& other) noexcept
      : read_(std::exchange(other.read_, -1)), write_(std::exchange(other.write_, -1)) {}
  PrintedPipe& operator=(PrintedPipe&&) = delete;
  ~PrintedPipe();

  int write_end() const { return write_; }  // above the standard descriptors and a channel's
  void close_write_end();                   // to be called once the worker has it
  // What came since the last call, in printable lines.
  std::string take();

 private:
  PrintedPipe(int read, int write) : read_(read), write_(write) {}
  int read_, write_;
};

}  // namespace assay::properties
