// What the tests of the worker run, and the child processes of a test.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "properties/worker/case_run.h"
#include "tests/properties/small_case.h"

namespace assay::properties::test {

inline const std::vector<Configuration> plugin_alone = {{"plug-in", {}}};

// Processes whose parent is this one, dead ones that nobody has waited for included.
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

// What the system says of a process; nothing once it is gone.
inline std::string stat_of(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  return {std::istreambuf_iterator<char>(stat), {}};
}

// Kills a child and returns when it has ended, though nobody has waited for it.
inline void end_child(int child, int signal = SIGKILL) {
  if (signal != 0) kill(child, signal);
  siginfo_t seen = {};
  EXPECT_EQ(waitid(P_PID, static_cast<id_t>(child), &seen, WEXITED | WNOWAIT), 0);
}

// Whether it is so, at once or within a minute.
inline bool comes_true(const std::function<bool()>& holds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// A case on which troubled_builtin.cpp uses so much processor time.
inline corpus::Case burning_case(double seconds) {
  auto c = small_case(31, 0);
  for (auto& frame : c.frames) frame(0, 0) = seconds;
  return c;
}

}  // namespace assay::properties::test
