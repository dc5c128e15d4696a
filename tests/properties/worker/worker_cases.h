// Cases for the tests of the worker, and functions about the child processes of a test.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "properties/worker/case_run.h"
#include "tests/properties/small_case.h"

namespace assay::properties::test {

inline const std::vector<Configuration> plugin_alone = {{"plug-in", {}}};

// Returns the child processes of this process, including dead processes that nobody has waited for.
inline std::vector<int> children() {
  std::vector<int> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);)
      if (line == "PPid:\t" + std::to_string(getpid())) found.push_back(std::stoi(name));
  }
  return found;
}

// Returns /proc/PROCESS/stat; empty if the process is gone.
inline std::string stat_of(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  return {std::istreambuf_iterator<char>(stat), {}};
}

// Kills a child, and returns when it has ended. The child stays to be waited for.
inline void end_child(int child, int signal = SIGKILL) {
  if (signal != 0) kill(child, signal);
  siginfo_t seen = {};
  EXPECT_EQ(waitid(P_PID, static_cast<id_t>(child), &seen, WEXITED | WNOWAIT), 0);
}

// Returns whether holds() becomes true within a minute.
inline bool comes_true(const std::function<bool()>& holds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// Returns a case on which troubled_builtin.cpp uses this much processor time.
inline corpus::Case burning_case(double seconds) {
  auto c = small_case(31, 0);
  for (auto& frame : c.frames) frame(0, 0) = seconds;
  return c;
}

}  // namespace assay::properties::test
