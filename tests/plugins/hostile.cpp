// A detector that answers nothing, claims everything, and tries to be certified all the same: by
// forging the replies of its worker, by changing what it is judged by, or by harming others. What
// it does is named by the variable ASSAY_HOSTILE (the tables below); ASSAY_VICTIM names a file
// that is not its own, ASSAY_BYSTANDER a process.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
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
#include "tests/plugins/forged_replies.h"

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

// ---- Calls that would change something outside. What succeeds is printed.

struct HostCall {
  const char* name;
  std::function<long()> make;  // negative: refused
};

std::vector<HostCall> host_calls(const std::string& victim) {
  static const std::string folder = victim.substr(0, victim.rfind('/'));
  static const char *file = nullptr, *place = nullptr;
  static const std::string kept = victim;
  file = kept.c_str(), place = folder.c_str();
  static int f = -1;
  f = open(file, O_RDONLY);
  static struct flock reading = {};
  reading.l_type = F_RDLCK;
  static const timespec times[2] = {{1, 0}, {2, 0}};
  static long words[8] = {};
  constexpr unsigned long long flag = 0x40 /* FS_NODUMP_FL */;
  words[0] = flag;
  constexpr long beyond = 1L << 32;  // the system cuts this off
  constexpr const char* attribute = "user.assay";
  const auto call = [](auto... arguments) { return [=] { return syscall(arguments...); }; };
  return {
      {"chmod", call(SYS_chmod, file, 04777)},
      {"chmod of the folder", call(SYS_chmod, place, 0777)},
      {"chmod of the scratch folder", call(SYS_chmod, getenv("TMPDIR"), 04777)},
      {"fchmod", call(SYS_fchmod, f, 04777)},
      {"fchmodat", call(SYS_fchmodat, AT_FDCWD, file, 0777)},
      {"fchmodat2", call(452, AT_FDCWD, file, 0777, 0)},
      {"chown", call(SYS_chown, file, getuid(), -1)},
      {"fchown", call(SYS_fchown, f, geteuid(), -1)},
      {"lchown", call(SYS_lchown, file, geteuid(), -1)},
      {"fchownat", call(SYS_fchownat, AT_FDCWD, file, geteuid(), -1, 0)},
      {"setxattr", call(SYS_setxattr, file, attribute, "x", 1, 0)},
      {"lsetxattr", call(SYS_lsetxattr, file, attribute, "x", 1, 0)},
      {"fsetxattr", call(SYS_fsetxattr, f, attribute, "x", 1, 0)},
      {"setxattrat", call(463, AT_FDCWD, file, 0, attribute, words, 16)},
      {"removexattr", call(SYS_removexattr, file, "user.kept")},
      {"lremovexattr", call(SYS_lremovexattr, file, "user.kept")},
      {"fremovexattr", call(SYS_fremovexattr, f, "user.kept")},
      {"removexattrat", call(466, AT_FDCWD, file, 0, "user.kept")},
      {"utime", call(SYS_utime, file, nullptr)},
      {"utimes", call(SYS_utimes, file, nullptr)},
      {"futimesat", call(SYS_futimesat, AT_FDCWD, file, nullptr)},
      {"utimensat", call(SYS_utimensat, AT_FDCWD, file, times, 0)},
      {"futimens", call(SYS_utimensat, f, nullptr, times, 0)},
      {"lease", call(SYS_fcntl, f, F_SETLEASE, F_RDLCK)},
      {"lock", call(SYS_fcntl, f, F_SETLK, &reading)},
      {"lock and wait", call(SYS_fcntl, f, F_SETLKW, &reading)},
      {"lock of the open file", call(SYS_fcntl, f, F_OFD_SETLK, &reading)},
      {"lock of the open file and wait", call(SYS_fcntl, f, F_OFD_SETLKW, &reading)},
      {"lock, by a longer number", call(SYS_fcntl, f, beyond | F_SETLK, &reading)},
      {"flock, shared", call(SYS_flock, f, LOCK_SH | LOCK_NB)},
      {"flock", call(SYS_flock, f, LOCK_EX | LOCK_NB)},
      {"hint of life", call(SYS_fcntl, f, 1036, words)},
      {"flags", call(SYS_ioctl, f, _IOW('f', 2, long), words)},
      {"flags, by a longer number", call(SYS_ioctl, f, beyond | _IOW('f', 2, long), words)},
      {"attributes of XFS", call(SYS_ioctl, f, 0x401c5820, words)},
      {"attributes by path", call(469, AT_FDCWD, file, words, 32, 0)},
      {"seal", call(SYS_ioctl, f, 0x40806685, words)},
      {"terminal", call(SYS_ioctl, 0, 0x5412 /* TIOCSTI */, "x")},
      {"truncate", call(SYS_truncate, file, 0)},
      {"open for writing", call(SYS_open, file, O_WRONLY)},
      {"rename", call(SYS_rename, file, (new std::string(kept + ".gone"))->c_str())},
      {"unlink", call(SYS_unlink, file)},
      {"link", call(SYS_link, file, (new std::string(kept + ".too"))->c_str())},
      {"symlink", call(SYS_symlink, file, (new std::string(kept + ".too"))->c_str())},
      {"mkdir", call(SYS_mkdir, (new std::string(kept + ".folder"))->c_str(), 0777)},
      {"mknod", call(SYS_mknod, (new std::string(kept + ".pipe"))->c_str(), S_IFIFO | 0666, 0)},
      {"mount", call(SYS_mount, "none", place, "tmpfs", 0, nullptr)},
      {"kill", call(SYS_kill, bystander(), SIGKILL)},
      {"priority", call(SYS_setpriority, 0, bystander(), 19)},
      {"priority of the disk", call(SYS_ioprio_set, 1, bystander(), 3 << 13)},
      {"limits", call(SYS_prlimit64, bystander(), RLIMIT_CORE, words, nullptr)},
      {"processors", call(SYS_sched_setaffinity, bystander(), sizeof words, words)},
      {"process", call(SYS_pidfd_open, bystander(), 0)},
      {"memory without a folder", call(SYS_memfd_create, "x", 0)},
      {"memory of System V", call(SYS_shmget, 0x41535359, 4096, 01666)},
      {"queue of System V", call(SYS_msgget, 0x41535359, 01666)},
      {"semaphore of System V", call(SYS_semget, 0x41535359, 1, 01666)},
      {"queue", call(SYS_mq_open, "assay", O_CREAT | O_RDWR, 0666, nullptr)},
      {"key", call(SYS_add_key, "user", "assay", "x", 1, -4)},
      {"network", call(SYS_socket, AF_INET, SOCK_STREAM, 0)},
      {"ring", call(SYS_io_uring_setup, 1, words)},
      {"another user", call(SYS_unshare, 0x10000000 /* CLONE_NEWUSER */)},
      {"name", call(SYS_sethostname, "assay", 5)},
  };
}

// Tells whether anything was not refused.
[[noreturn]] void change_host(const std::string& victim) {
  bool is_refused = true;
  for (const auto& call : host_calls(victim)) {
    if (call.make() < 0) continue;
    std::printf("%s\n", call.name);
    is_refused = false;
  }
  std::fflush(stdout);
  tell(!is_refused);
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
  all["queue-bystander"] = [] { sigqueue(bystander(), SIGKILL, {}); };
  all["trace-bystander"] = [] { ptrace(PTRACE_ATTACH, bystander(), nullptr, nullptr); };
  all["write-bystander"] = [] {
    static int word = 0;
    iovec from = {&word, sizeof word}, to = {reinterpret_cast<void*>(0x400000), sizeof word};
    process_vm_writev(bystander(), &from, 1, &to, 1, 0);
  };
  all["memory-of-bystander"] = [] { overwrite("/proc/" + std::to_string(bystander()) + "/mem"); };
  all["memory-of-parent"] = [] { overwrite("/proc/" + std::to_string(getppid()) + "/mem"); };
  all["descriptors"] = [] {
    for (int d = 3; d < most_descriptors; ++d) (void)!write(d, "garbage!garbage!garbage!", 24);
  };
  all["close-descriptors"] = [] {
    for (int d = 3; d < most_descriptors; ++d) close(d);
  };
  all["descriptors-of-parent"] = [] {
    for (int d = 3; d < 16; ++d) {
      overwrite("/proc/" + std::to_string(getppid()) + "/fd/" + std::to_string(d));
    }
  };
  all["many-processes"] = [] {
    for (int i = 0; i < 2000; ++i) start_a_sleeper();
  };
  // Whether the system lets it.
  all["more-processes-than-allowed"] = [] {
    constexpr int allowed = 512;
    for (int i = 0; i < allowed; ++i)
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
  all["root-again"] = [] { tell(setreuid(0, 0) == 0 || setresuid(0, 0, 0) == 0); };
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
  all["new-user"] = [] {
    (void)!setuid(0);
    (void)!setgid(0);
  };
  all["stop-itself"] = [] { raise(SIGSTOP); };
  all["wait-for-a-child"] = [] {
    if (vfork() == 0)
      for (;;) pause();
  };
  all["change-host"] = [] { change_host(victim); };
  all["fill-scratch"] = [] { fill(variable("TMPDIR") + "/much", std::size_t{3} << 28); };
  all["fill-shared-memory"] = [] { fill("/dev/shm/much", std::size_t{3} << 28); };
  // A call of x32, which the filter cannot know by its number.
  all["foreign-call"] = [] {
    constexpr long of_x32 = 0x40000000;
    syscall(of_x32 | SYS_chmod, victim.c_str(), 0777);
    _exit(3);
  };
#if defined(__x86_64__)
  // A call of i386: chmod, by the number that it has there.
  all["older-call"] = [] {
    long low = -1;
    void* room =
        mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_32BIT, -1, 0);
    std::strncpy(static_cast<char*>(room), victim.c_str(), 4095);
    asm volatile("int $0x80" : "=a"(low) : "a"(15L), "b"(room), "c"(0777L) : "memory");
    _exit(3);
  };
#endif
  // What the victim holds.
  all["read"] = [] { tell(open(victim.c_str(), O_RDONLY) >= 0); };
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

void meddle() {
  const auto deed = deeds().find(variable("ASSAY_HOSTILE"));
  if (deed != deeds().end()) deed->second();
}

// Scenes are larger. To judge its answers on these takes the oracle longer than all the rest, so
// most modes end there when their deed is done.
constexpr std::uint64_t triangles_of_a_case = 200;

void spare_the_oracle(std::uint64_t triangles) {
  const std::string mode = variable("ASSAY_HOSTILE");
  if (triangles > triangles_of_a_case && mode != "forge-lies" && mode != "overwrite") _exit(0);
}

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
  meddle();
  spare_the_oracle(m);
  return honest().create(triangles, m, x, n, handle, message);
}
std::int32_t result(assay_handle* handle, assay_result* result) {
  at("result");
  return honest().result(handle, result);
}

}  // namespace

const assay_detector_api* assay_detector() {
  at("load");
  const std::string mode = variable("ASSAY_HOSTILE");
  assay::tests::forge(mode);
  static const assay_detector_api api = [] {
    assay_detector_api table = honest();
    table.create = create;
    table.result = result;
    return table;
  }();
  return &api;
}
