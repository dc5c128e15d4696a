// What a plug-in prints, on its way from its process over the keeper to the host, a case at a time.
// It is kept for people, and nothing is judged by it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace assay::properties {

// Bytes that are kept of what is printed in one case: the last ones, which say how it ended.
inline constexpr std::size_t longest_printed = 4096;

// The end of a text that grows. Where its beginning is lost it begins with "..." and a whole line.
class LastWords {
 public:
  void add(const char* bytes, std::size_t size);
  bool empty() const { return kept_.empty(); }
  std::string take();

 private:
  std::string kept_;
  bool is_cut_ = false;
};

// What there is to read of a descriptor that does not wait, 1 MB at most a call. False when nobody
// can write to it any more.
bool read_what_is_there(int descriptor, LastWords& words);

// Lines of printable text (printable.h), none of them empty at the end.
std::string printable_lines(const std::string& text);

// The host's end, and the one that its worker is started with.
class PrintedPipe {
 public:
  // Nothing when the system has no more descriptors.
  static std::optional<PrintedPipe> make();
  PrintedPipe(PrintedPipe&& other) noexcept
      : read_(std::exchange(other.read_, -1)), write_(std::exchange(other.write_, -1)) {}
  PrintedPipe& operator=(PrintedPipe&&) = delete;
  ~PrintedPipe();

  int write_end() const { return write_; }  // above the standard descriptors and a channel's
  void close_write_end();                   // once the worker has it
  // What came since it was asked last, in printable lines.
  std::string take();

 private:
  PrintedPipe(int read, int write) : read_(read), write_(write) {}
  int read_, write_;
};

}  // namespace assay::properties
