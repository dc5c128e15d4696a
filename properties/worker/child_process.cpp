#include "properties/worker/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

extern char** environ;

namespace assay::properties {

namespace {

std::string end_text(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return "killed by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  }
  return "exited with code " + std::to_string(WEXITSTATUS(status));
}

// Whether the child has ended, or is none of ours any more; waits unless `options` say otherwise.
bool reap(pid_t id, int options, int& status) {
  pid_t got;
  do {
    got = ::waitpid(id, &status, options);
  } while (got < 0 && errno == EINTR);
  return got != 0;
}

}  // namespace

std::optional<ChildProcess> ChildProcess::start(const std::filesystem::path& program,
                                                const std::vector<std::string>& arguments,
                                                int descriptor, std::string& problem) {
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv = {name.data()};
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, descriptor, child_descriptor);
  pid_t id = -1;
  const int error = ::posix_spawn(&id, name.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    problem = "cannot start " + name + ": " + std::strerror(error);
    return std::nullopt;
  }
  return ChildProcess(id);
}

std::string ChildProcess::finish(std::chrono::milliseconds patience) {
  if (id_ < 0) return "";
  int status = 0;
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!reap(id_, WNOHANG, status)) {
    if (std::chrono::steady_clock::now() >= until) {
      ::kill(id_, SIGKILL);
      reap(id_, 0, status);
      id_ = -1;
      return "";
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  id_ = -1;
  return end_text(status);
}

ChildProcess::~ChildProcess() {
  constexpr std::chrono::milliseconds patience{200};
  finish(patience);
}

}  // namespace assay::properties
