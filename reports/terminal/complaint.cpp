#include "reports/terminal/complaint.h"

#include <cstdio>

namespace assay::reports {

int refuse(const std::string& line) noexcept {
  constexpr std::size_t longest = 1000;
  std::fputs("assay: ", stderr);
  for (std::size_t i = 0; i < line.size() && i < longest; ++i) {
    const auto c = static_cast<unsigned char>(line[i]);
    constexpr unsigned char first_printable = 0x20, del = 0x7f;
    std::fputc(c < first_printable || c == del ? '?' : c, stderr);
  }
  if (line.size() > longest) std::fputs(" ...", stderr);
  std::fputc('\n', stderr);
  return exit_usage;
}

bool output_was_written() noexcept {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  refuse("standard output cannot be written");
  return false;
}

}  // namespace assay::reports
