#include "reports/terminal/complaint.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <thread>

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

int refuse(const Problem& problem) noexcept { return refuse(problem.message); }

bool output_was_written() noexcept {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  refuse("standard output cannot be written");
  return false;
}

void end_when_interrupted(const std::string& line, int code) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals, line, code] {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    fmt::print("\n{}\n", line);
    std::fflush(stdout);
    // The program ends at once, whatever the other threads are doing, because a store is whole at
    // any moment.
    _exit(code);
  }).detach();
}

}  // namespace assay::reports
