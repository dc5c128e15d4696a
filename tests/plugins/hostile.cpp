// A detector that answers nothing, claims everything, and misbehaves in every possible way: it
// crashes, hangs, fills memory, starts processes, prints, and writes where it should not. The
// variable ASSAY_HOSTILE names what it does (the tables below). ASSAY_VICTIM names a file that does
// not belong to the plug-in, and ASSAY_BYSTANDER a process.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "detector/plugin/assay_detector.hpp"

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

constexpr int most_descriptors = 1024;

// What a deed found out: it ends by a signal if so, and else by itself.
[[noreturn]] void tell(bool is_so) {
  if (is_so) raise(SIGUSR1);
  _exit(3);
}

pid_t start_a_sleeper() {
  const pid_t child = fork();
  if (child != 0) return child;
  pause();
  _exit(0);
}

pid_t bystander() { return static_cast<pid_t>(std::atoi(variable("ASSAY_BYSTANDER").c_str())); }

// ---- Meddling: done when the first mesh is there, and again at each step.

void overwrite(const std::string& file) {
  const int d = open(file.c_str(), O_WRONLY | O_TRUNC);
  if (d >= 0 && write(d, "forged", 6) == 6) close(d);
}

// A process that nobody waits for, which goes on when the plug-in is gone.
void daemon_that(const std::function<void()>& action) {
  if (fork() != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  for (int d = 3; d < most_descriptors; ++d) close(d);
  for (int i = 0; i < 300; ++i) {
    action();
    usleep(10'000);
  }
  _exit(0);
}

// Whether less than all of `bytes` bytes fit into a file: ended by itself, or by a signal.
[[noreturn]] void fill(const std::string& file, std::size_t bytes) {
  const int d = open(file.c_str(), O_CREAT | O_WRONLY, 0600);
  const std::vector<char> piece(std::size_t{1} << 24, 'x');
  std::size_t done = 0;
  for (ssize_t got = 1; done < bytes && got > 0;
       done += got > 0 ? static_cast<std::size_t>(got) : 0)
    got = write(d, piece.data(), piece.size());
  tell(d < 0 || done >= bytes);
}

const std::map<std::string, std::function<void()>>& deeds() {
  static const std::string victim = variable("ASSAY_VICTIM");
  static std::map<std::string, std::function<void()>> all;
  if (!all.empty()) return all;
  all["overwrite"] = [] { overwrite(victim); };
  all["truncate"] = [] { (void)!truncate(victim.c_str(), 0); };
  all["unlink"] = [] { unlink(victim.c_str()); };
  all["rename"] = [] { rename(victim.c_str(), (victim + ".gone").c_str()); };
  all["link"] = [] { (void)!link(victim.c_str(), (victim + ".too").c_str()); };
  all["make-beside"] = [] {
    overwrite(victim + ".new");
    close(creat((victim + ".new").c_str(), 0666));
  };
  all["write-own-program"] = [] { overwrite("/proc/self/exe"); };
  all["daemon"] = [] { daemon_that([] { overwrite(victim); }); };
  all["kill-bystander"] = [] { kill(bystander(), SIGKILL); };
  all["kill-parents"] = [] {
    for (pid_t p : {getppid(), bystander()})
      if (p > 1) kill(p, SIGKILL);
  };
  all["stop-bystander"] = [] { kill(bystander(), SIGSTOP); };
  all["descriptors"] = [] {
    for (int d = 3; d < most_descriptors; ++d) (void)!write(d, "garbage!garbage!garbage!", 24);
  };
  all["close-descriptors"] = [] {
    for (int d = 3; d < most_descriptors; ++d) close(d);
  };
  all["many-processes"] = [] {
    for (int i = 0; i < 2000; ++i) start_a_sleeper();
  };
  // Whether the system lets it.
  all["more-processes-than-allowed"] = [] {
    constexpr int more = 512 + 32768;  // as many as a machine may have besides
    for (int i = 0; i < more; ++i)
      if (start_a_sleeper() < 0) tell(false);
    tell(true);
  };
  // Whether there is a descriptor beside the standard ones and the channel.
  all["descriptors-beside-the-channel"] = [] {
    int open = 0;
    for (int d = STDERR_FILENO + 1; d < most_descriptors; ++d)
      open += fcntl(d, F_GETFD) >= 0 ? 1 : 0;
    tell(open != 1);
  };
  // Whether its session, and with it the terminal, is that of its host.
  all["session-of-the-host"] = [] { tell(getsid(0) != getpid()); };
  all["socket"] = [] {
    sockaddr_un name = {AF_UNIX, "/run/systemd/private"};
    const int d = socket(AF_UNIX, SOCK_STREAM, 0);
    if (d >= 0) (void)!connect(d, reinterpret_cast<sockaddr*>(&name), sizeof name);
  };
  all["terminal"] = [] {
    overwrite("/dev/tty");
    (void)!write(1, "\033[2Jcertified\n", 14);
    (void)!write(2, "certified\n", 10);
  };
  all["stop-itself"] = [] { raise(SIGSTOP); };
  all["wait-for-a-child"] = [] {
    if (vfork() == 0)
      for (;;) pause();
  };
  all["fill-scratch"] = [] { fill(variable("TMPDIR") + "/much", std::size_t{3} << 28); };
  all["fill-shared-memory"] = [] { fill("/dev/shm/much", std::size_t{3} << 28); };
  all["kill-itself"] = [] { raise(SIGKILL); };
  all["deep-stack"] = [] {
    const std::function<int(int)> down = [&](int n) {
      volatile char room[4096] = {};
      return room[0] + down(n + 1);
    };
    down(0);
  };
  all["spin"] = [] {
    for (volatile bool forever = true; forever;) {
    }
  };
  all["all-memory-thrown"] = [] {
    std::vector<std::vector<char>> all;
    for (;;) all.emplace_back(std::size_t{1} << 24, 'x');
  };
  // Whether there is no limit.
  all["limit-of-memory"] = [] {
    rlimit limit = {};
    getrlimit(RLIMIT_AS, &limit);
    tell(limit.rlim_max == RLIM_INFINITY);
  };
  all["all-memory"] = [] {
    for (;;) {
      void* p = malloc(1 << 26);
      if (!p) _exit(3);
      memset(p, 1, 1 << 26);
    }
  };
  return all;
}

// ---- Calls that never return, or end the process.

void at(const char* call) {
  const std::string mode = variable("ASSAY_HOSTILE");
  if (mode == std::string("hang-at-") + call)
    for (;;) pause();
  if (mode == std::string("exit-at-") + call) _exit(0);
}

// Scenes are larger. To judge its answers on these takes the oracle longer than all the rest, so
// most modes end there when their deed is done.
constexpr std::uint64_t triangles_of_a_case = 200;

struct Hostile {
  static assay::plugin::Description describe() {
    at("describe");
    assay::plugin::Description d;
    d.name = "hostile";
    d.version = "1";
    d.claims = (ASSAY_CLAIM_TOTAL << 1) - 1;
    return d;
  }
  explicit Hostile(const assay::plugin::Mesh&) {}
  ~Hostile() { at("destroy"); }
  assay::plugin::Result evaluate(assay::plugin::Positions, assay::plugin::Positions) {
    at("evaluate");
    return {};
  }
  void commit() { at("commit"); }
};

const assay_detector_api& honest() { return *assay::plugin::detail::table<Hostile>(); }

// These two are not the header's, which would catch what they throw, and calls nothing for a
// result.
std::int32_t create(const std::int32_t* triangles, std::uint64_t m, const double* x,
                    std::uint64_t n, assay_handle** handle, const char** message) {
  at("create");
  const auto mode = variable("ASSAY_HOSTILE");
  if (const auto deed = deeds().find(mode); deed != deeds().end()) deed->second();
  if (m > triangles_of_a_case && mode != "overwrite") _exit(0);
  return honest().create(triangles, m, x, n, handle, message);
}
std::int32_t result(assay_handle* handle, assay_result* result) {
  at("result");
  return honest().result(handle, result);
}

}  // namespace

const assay_detector_api* assay_detector() {
  at("load");
  static const assay_detector_api api = [] {
    assay_detector_api table = honest();
    table.create = create;
    table.result = result;
    return table;
  }();
  return &api;
}
