#include "reports/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

namespace assay::reports {

Progress::Progress(std::string title)
    : on_terminal_(isatty(STDERR_FILENO) == 1),
      title_(std::move(title)),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_) {}

void Progress::phase(std::string name) {
  phase_ = std::move(name);
  tick();
}

void Progress::tick() {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (on_terminal_ ? std::chrono::milliseconds(200ms) : 60s)) return;
  last_ = now;
  drawn_ = on_terminal_;
  const std::chrono::duration<double> elapsed = now - begin_;
  const auto line = fmt::format("{}: {} {:.0f} s", title_, phase_, elapsed.count());
  if (on_terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
  } else {
    fmt::print(stderr, "{}\n", line);
  }
}

void Progress::finish() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace assay::reports
