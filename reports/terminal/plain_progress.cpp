#include "reports/terminal/plain_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace assay::reports {

PlainProgress::PlainProgress(std::string title)
    : on_terminal_(isatty(fileno(stdout)) != 0),
      title_(std::move(title)),
      last_(std::chrono::steady_clock::now()) {}

void PlainProgress::show(const std::string& text) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (on_terminal_ ? std::chrono::milliseconds(200ms) : 20s)) return;
  last_ = now;
  drawn_ = true;
  if (on_terminal_) {
    fmt::print("\r\033[K{}: {}", title_, text);
  } else {
    fmt::print("{}: {}\n", title_, text);
  }
  std::fflush(stdout);
}

void PlainProgress::finish() {
  if (on_terminal_ && drawn_) fmt::print("\r\033[K");
  drawn_ = false;
}

}  // namespace assay::reports
