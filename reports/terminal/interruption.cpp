#include "reports/terminal/interruption.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <thread>

namespace assay::reports {

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
