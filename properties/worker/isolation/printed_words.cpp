#include "properties/worker/isolation/printed_words.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "properties/printable.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

void LastWords::add(const char* bytes, std::size_t size) {
  kept_.append(bytes, size);
  if (kept_.size() <= longest_printed) return;
  kept_.erase(0, kept_.size() - longest_printed);
  is_cut_ = true;
}

std::string LastWords::take() {
  std::string text = std::exchange(kept_, {});
  if (!std::exchange(is_cut_, false)) return text;
  const auto line = text.find('\n');
  return "...\n" + (line == std::string::npos ? text : text.substr(line + 1));
}

bool read_what_is_there(int descriptor, LastWords& words) {
  constexpr int most_reads = 16;
  std::array<char, 1 << 16> bytes;
  for (int i = 0; i < most_reads; ++i) {
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno == EAGAIN;
    if (got == 0) return false;
    words.add(bytes.data(), static_cast<std::size_t>(got));
  }
  return true;
}

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

std::optional<PrintedPipe> PrintedPipe::make() {
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return std::nullopt;
  const int high = ::fcntl(ends[1], F_DUPFD_CLOEXEC, printed_descriptor + 1);
  ::close(ends[1]);
  if (high < 0) {
    ::close(ends[0]);
    return std::nullopt;
  }
  return PrintedPipe(ends[0], high);
}

PrintedPipe::~PrintedPipe() {
  if (read_ >= 0) ::close(read_);
  close_write_end();
}

void PrintedPipe::close_write_end() {
  if (write_ >= 0) ::close(std::exchange(write_, -1));
}

std::string PrintedPipe::take() {
  LastWords words;
  read_what_is_there(read_, words);
  return printable_lines(words.take());
}

}  // namespace assay::properties
