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
  if (!on_terminal_) return;
  constexpr auto between = std::chrono::milliseconds(200);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < between) return;
  last_ = now;
  drawn_ = true;
  const std::chrono::duration<double> elapsed = now - begin_;
  fmt::print(stderr, "\r\033[K{}: {} {:.0f} s", title_, phase_, elapsed.count());
}

void Progress::finish() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace assay::reports
