#include "properties/worker/isolation/printed_words.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "properties/printable.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

std::string printable_lines(const std::string& text) {
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t length = end - begin - (end > begin && text[end - 1] == '\r' ? 1 : 0);
    lines += printable(std::string_view(text).substr(begin, length)) + "\n";
    begin = end + 1;
  }
  while (lines.ends_with('\n')) lines.pop_back();
  return lines;
}

std::optional<PrintedFile> PrintedFile::make() {
  const int low = ::memfd_create("printed", MFD_CLOEXEC);
  if (low < 0) return std::nullopt;
  const int file = ::fcntl(low, F_DUPFD_CLOEXEC, least_passed_descriptor);
  ::close(low);
  if (file < 0) return std::nullopt;
  ::fcntl(file, F_SETFL, O_APPEND);
  return PrintedFile(file);
}

PrintedFile::~PrintedFile() {
  if (file_ >= 0) ::close(file_);
}

void PrintedFile::move_to_kept() {
  struct stat seen = {};
  if (::fstat(file_, &seen) != 0 || seen.st_size == 0) return;
  const auto size = static_cast<std::size_t>(seen.st_size), last = std::min(size, longest_printed);
  std::string end(last, '\0');
  const ssize_t got = ::pread(file_, end.data(), last, static_cast<off_t>(size - last));
  (void)!::ftruncate(file_, 0);
  kept_.append(end, 0, got > 0 ? static_cast<std::size_t>(got) : 0);
  is_cut_ = is_cut_ || size > last || kept_.size() > longest_printed;
  if (kept_.size() > longest_printed) kept_.erase(0, kept_.size() - longest_printed);
}

void PrintedFile::keep_short() {
  constexpr off_t long_text = 1 << 20;
  struct stat seen = {};
  if (::fstat(file_, &seen) == 0 && seen.st_size > long_text) move_to_kept();
}

std::string PrintedFile::take() {
  move_to_kept();
  std::string text = std::exchange(kept_, {});
  if (std::exchange(is_cut_, false)) {
    const auto line = text.find('\n');
    text = "...\n" + (line == std::string::npos ? text : text.substr(line + 1));
  }
  return printable_lines(text);
}

}  // namespace assay::properties
