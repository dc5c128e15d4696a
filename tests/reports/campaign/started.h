// Starts the program in the background, as a shell does.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include "tests/test.h"

extern char** environ;

namespace assay::tests {

// A run of the program in its own process group. Its output goes to the file `output`.
class Started {
 public:
  Started(std::vector<std::string> words, const std::string& output) {
    words.insert(words.begin(), ASSAY_PROGRAM);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    EXPECT_EQ(posix_spawn(&id_, ASSAY_PROGRAM, &actions, &attributes, argv.data(), environ), 0);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;
  ~Started() {
    if (id_ > 0) send(SIGKILL), end();
  }
  pid_t id() const { return id_; }
  bool has_ended() const {
    siginfo_t seen = {};
    return waitid(P_PID, static_cast<id_t>(id_), &seen, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           seen.si_pid != 0;
  }
  // Sends a signal to all processes of the group, as a terminal does.
  void send(int signal) const { kill(-id_, signal); }
  int end() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
};

}  // namespace assay::tests
