#include "reports/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

namespace assay::reports {

using Clock = std::chrono::steady_clock;

PlainProgress::PlainProgress(std::string title, std::FILE* out, std::chrono::seconds between_lines)
    : out_(out),
      on_terminal_(isatty(fileno(out)) == 1),
      between_(on_terminal_ ? Clock::duration(std::chrono::milliseconds(200)) : between_lines),
      title_(std::move(title)),
      last_(Clock::now()) {}

bool PlainProgress::is_due() const { return Clock::now() - last_ >= between_; }

void PlainProgress::show(const std::string& text) {
  if (!is_due()) return;
  last_ = Clock::now();
  drawn_ = on_terminal_;
  fmt::print(out_, "{}{}: {}{}", on_terminal_ ? "\r\033[K" : "", title_, text,
             on_terminal_ ? "" : "\n");
  std::fflush(out_);
}

void PlainProgress::finish() {
  if (drawn_) fmt::print(out_, "\r\033[K");
  drawn_ = false;
}

Progress::Progress(std::string title, std::chrono::seconds between_lines)
    : line_(std::move(title), stderr, between_lines), begin_(Clock::now()) {}

void Progress::phase(std::string name) {
  phase_ = std::move(name);
  tick();
}

void Progress::tick() {
  if (!line_.is_due()) return;
  const std::chrono::duration<double> elapsed = Clock::now() - begin_;
  line_.show(fmt::format("{} {:.0f} s", phase_, elapsed.count()));
}

}  // namespace assay::reports
