#include "properties/worker/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

extern char** environ;
namespace assay::properties {

namespace {

ChildEnd end_of(int status) {
  if (WIFSIGNALED(status)) return end_by_signal(WTERMSIG(status));
  ChildEnd end;
  end.code = WEXITSTATUS(status);
  end.text = "exited with code " + std::to_string(end.code);
  return end;
}

enum class State { runs, ended, not_ours };

State state_of(pid_t id) {
  siginfo_t seen = {};
  int got;
  do {
    got = ::waitid(P_PID, static_cast<id_t>(id), &seen, WEXITED | WNOHANG | WNOWAIT);
  } while (got < 0 && errno == EINTR);
  if (got < 0) return State::not_ours;
  return seen.si_pid == 0 ? State::runs : State::ended;
}

}  // namespace

ChildEnd end_by_signal(int signal) {
  ChildEnd end;
  end.signal = signal;
  end.text = "killed by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  return end;
}

ChildEnd end_of_child(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return end_of(status);
}

bool was_killed_from_outside(const ChildEnd& end) {
  constexpr std::array from_outside = {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT};
  return !end.by_host &&
         std::find(from_outside.begin(), from_outside.end(), end.signal) != from_outside.end();
}

Expected<ChildProcess> ChildProcess::start(const std::filesystem::path& program,
                                           const std::vector<std::string>& arguments,
                                           const std::vector<PassedDescriptor>& descriptors) {
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv = {name.data()};
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const auto& [here, there] : descriptors)
    ::posix_spawn_file_actions_adddup2(&actions, here, there);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  pid_t id = -1;
  const int error = ::posix_spawnp(&id, name.c_str(), &actions, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    return Problem{"cannot start " + name + ": " + std::strerror(error)};
  }
  return ChildProcess(id);
}

bool ChildProcess::has_ended() const { return id_ < 0 || state_of(id_) != State::runs; }

ChildEnd ChildProcess::finish(std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  bool in_time = true;
  while (!has_ended() && in_time) {
    in_time = std::chrono::steady_clock::now() < until;
    if (in_time) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  ChildEnd end = end_of(0);
  if (id_ >= 0) {
    // The number of the group is not used again as long as nobody has waited for its leader.
    if (state_of(id_) != State::not_ours) ::kill(-id_, SIGKILL);
    end = end_of_child(id_);
    id_ = -1;
  }
  end.by_host = !in_time && end.signal == SIGKILL;
  if (end.by_host) end.text.clear();
  return end;
}

ChildProcess::~ChildProcess() {
  constexpr std::chrono::milliseconds patience{200};
  finish(patience);
}

namespace {

// What the copy says last, if its work threw: this mark, and what() of the exception.
constexpr char threw = '\1', ran_out_of_memory = '\2';

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);  // no memory is left for it
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

// A terminal's ctrl-C is for the host alone, which ends in its own way; the copy ends with it.
void live_with_the_host() {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(signal, SIG_DFL);
}

[[noreturn]] void run_in_the_copy(int descriptor, const std::function<void(const Say&)>& work) {
  live_with_the_host();
  ::dup2(descriptor, child_descriptor);
  ::close_range(child_descriptor + 1, ~0u, 0);
  const Say say = [](std::string_view text) { write_all(child_descriptor, text); };
  try {
    work(say);
  } catch (const std::bad_alloc&) {
    say({&ran_out_of_memory, 1});
  } catch (const std::exception& failure) {
    say(threw + std::string(failure.what()));
  }
  ::_exit(0);
}

// All that the copy has said.
std::string said_in(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t got = 1; got > 0; text.append(buffer.data(), static_cast<std::size_t>(got))) {
    got = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(text.size()));
    if (got < 0) got = 0;
  }
  return text;
}

}  // namespace

CopyRun in_a_copy(const std::function<void(const Say&)>& work) {
  const auto fail = [](const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
  };
  // The copy speaks into a file in memory: a pipe would wake this process for every line.
  const int file = ::memfd_create("said", MFD_CLOEXEC);
  if (file < 0) fail("no file in memory");
  const pid_t copy = ::fork();
  if (copy == 0) run_in_the_copy(file, work);
  if (copy < 0) {
    const int why = errno;
    ::close(file);
    errno = why;
    fail("no process");
  }
  CopyRun run;
  run.end = end_of_child(copy);
  run.said = said_in(file);
  ::close(file);
  if (run.said.ends_with(ran_out_of_memory)) throw std::bad_alloc();
  if (const auto at = run.said.find(threw); at != std::string::npos)
    throw std::runtime_error(run.said.substr(at + 1));
  return run;
}

}  // namespace assay::properties
