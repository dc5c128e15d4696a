#include "properties/worker/isolation/keeper.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>

#include "properties/worker/child_process.h"
#include "properties/worker/isolation/printed_words.h"
#include "properties/worker/isolation/walls.h"
#include "properties/worker/messages.h"

namespace assay::properties {
namespace {

// The process in which a plug-in is loaded, and how it is made ready.

// What the plug-in's processes tell the keeper, over a socket that the plug-in never has.
struct ChildReport {
  enum class Kind : std::uint8_t { ready, ended } kind = Kind::ready;
  Isolation isolation;      // when ready
  bool has_copies = false;  // when ready
  int status = 0;           // when ended: as waitpid tells it
};

// The descriptors that the plug-in's processes have. All others are closed.
struct ChildEnds {
  int channel = -1;  // the plug-in's end
  int reports = -1;  // leads to the keeper
  int printed = -1;  // where it prints; -1: where its starter prints
};

void report(int socket, const ChildReport& child_report) {
  ::send(socket, &child_report, sizeof child_report, MSG_NOSIGNAL);
}

// Closes every descriptor except the standard ones and the two of `ends`.
void close_all_but(const ChildEnds& ends) {
  const auto low = static_cast<unsigned>(std::min(ends.channel, ends.reports));
  const auto high = static_cast<unsigned>(std::max(ends.channel, ends.reports));
  constexpr unsigned first = STDERR_FILENO + 1, last = ~0U;
  if (low > first) ::close_range(first, low - 1, 0);
  if (high > low + 1) ::close_range(low + 1, high - 1, 0);
  ::close_range(high + 1, last, 0);
}

// Lets the plug-in print into a pipe to the keeper, because a line on the terminal of the user
// could be taken for one of the host.
void print_into(int pipe) {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nowhere, STDIN_FILENO);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    ::dup2(pipe >= 0 ? pipe : nowhere, stream);
  ::close(nowhere);
}

// The plug-in may have at most this many processes and threads, so that it leaves some to the
// machine.
constexpr rlim_t most_processes = 512;

void limit(const KeptPlugin& kept) {
  if (kept.mode != IsolationMode::none) {
    const rlimit processes = {most_processes, most_processes};
    ::setrlimit(RLIMIT_NPROC, &processes);
    // Where the scratch folder is one of the disk, each file in it has the limit of memory. A file
    // that would grow beyond is an error of the call, and not the end of the process.
    const rlimit size = {kept.bytes, kept.bytes};
    if (kept.bytes > 0) ::setrlimit(RLIMIT_FSIZE, &size);
    ::signal(SIGXFSZ, SIG_IGN);
  }
  if (!limit_memory(kept.bytes)) ::_exit(EXIT_FAILURE);
}

Isolation shut_in(const KeptPlugin& kept, bool in_new_world) {
  Isolation isolation;
  if (kept.mode == IsolationMode::none) return isolation;
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return isolation;
  std::vector<std::string> folders = {kept.scratch};
  if (in_new_world) folders.emplace_back(shared_memory);
  std::vector<std::string> unread;
  if (!kept.unread.empty()) unread.push_back(kept.unread);
  if (!in_new_world) unread.emplace_back("/proc");
  isolation.files = fence_files(folders, unread);
  const bool has_dropped = drop_capabilities();
  isolation.calls = filter_calls(!in_new_world) && has_dropped;
  // If the plug-in has no world of its own, /proc is behind the fence and the filter stops every
  // other way to other processes.
  isolation.processes = in_new_world || (isolation.files && isolation.calls);
  return isolation;
}

// The main function of the plug-in's process. It shuts itself in as far as it is asked to and the
// system allows, reports that, gives up the socket for reports, and serves. `in_new_world`: it was
// started in a new world; `has_copies`: in which all files are replaced.
[[noreturn]] void become_plugin(const KeptPlugin& kept, const ChildEnds& ends, bool in_new_world,
                                bool has_copies, const std::function<int(Channel)>& serve) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (kept.mode != IsolationMode::none) {
    ::setsid();  // it gets no terminal
    print_into(ends.printed);
    ::setenv("TMPDIR", kept.scratch.c_str(), 1);
  }
  close_all_but(ends);
  limit(kept);
  ChildReport ready;
  ready.isolation = shut_in(kept, in_new_world);
  ready.has_copies = has_copies;
  report(ends.reports, ready);
  ::close(ends.reports);
  if (kept.mode == IsolationMode::required && !ready.isolation.is_whole()) ::_exit(EXIT_SUCCESS);
  int code = EXIT_FAILURE;
  try {
    code = serve(Channel(ends.channel));
  } catch (const std::exception&) {
    ::abort();  // ends as an exception that nobody catches does
  }
  ::exit(code);
}

// The main function of the first process of a new world. It starts the plug-in's process, waits
// for whatever ends in that world, reports the end of the plug-in's process, and ends the world.
[[noreturn]] void begin_with_plugin(const KeptPlugin& kept, const ChildEnds& ends,
                                    const std::function<int(Channel)>& serve) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const bool is_alone = show_new_world(kept.scratch, kept.bytes);
  const bool has_copies = !kept.replaced.empty() && replace_files(kept.replaced);
  const pid_t plugin = ::fork();
  if (plugin == 0) become_plugin(kept, ends, is_alone, has_copies, serve);
  // The plug-in is the same user in the same world, and must not be able to read this process.
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
  ::close(ends.channel);
  if (ends.printed >= 0) ::close(ends.printed);
  ChildReport end;
  end.kind = ChildReport::Kind::ended;
  pid_t ended = plugin < 0 ? plugin : 0;
  while (ended != plugin) ended = ::waitpid(-1, &end.status, 0);
  report(ends.reports, end);
  ::_exit(EXIT_SUCCESS);
}

// The keeper itself.

// The process of the plug-in may take this long to end by itself when the host is gone.
constexpr int last_words_ms = 100;

// Sends all of the bytes. Returns false if the other end is gone.
bool pass_on(int socket, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = ::send(socket, bytes, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

enum class Passed { all, from_is_closed, to_is_closed };

// Passes on what can be read at once.
Passed pass_on_all(int from, int to) {
  std::array<char, 1 << 16> bytes;
  for (;;) {
    const ssize_t got = ::recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Passed::all;
    if (got <= 0) return Passed::from_is_closed;
    if (!pass_on(to, bytes.data(), static_cast<std::size_t>(got))) return Passed::to_is_closed;
  }
}

// A report, together with the process that sent it, as this process sees it.
struct Received {
  ChildReport report;
  pid_t sender = 0;
};

std::optional<Received> receive_report(int socket, int flags) {
  Received received;
  iovec bytes = {&received.report, sizeof received.report};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> beside = {};
  msghdr message = {};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = beside.data();
  message.msg_controllen = beside.size();
  ssize_t got;
  do {
    got = ::recvmsg(socket, &message, flags);
  } while (got < 0 && errno == EINTR);
  if (got != sizeof received.report) return std::nullopt;
  const cmsghdr* head = CMSG_FIRSTHDR(&message);
  if (head && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SCM_CREDENTIALS) {
    ucred who;
    std::memcpy(&who, CMSG_DATA(head), sizeof who);
    received.sender = who.pid;
  }
  return received;
}

[[noreturn]] void end_like(int status) {
  if (WIFSIGNALED(status)) {
    ::signal(WTERMSIG(status), SIG_DFL);
    ::raise(WTERMSIG(status));
  }
  ::_exit(WEXITSTATUS(status));
}

class Keeper {
 public:
  // `printed` is the descriptor from which the text that the plug-in prints is read, or -1 if it
  // is not read.
  Keeper(Channel host, int plugin, int reports, int printed, pid_t child)
      : host_(std::move(host)),
        plugin_(plugin),
        reports_(reports),
        printed_(printed),
        child_(child) {
    ended_ = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  }

  [[noreturn]] void run() {
    // If there is no report, the process of the plug-in has ended already.
    if (const auto ready = receive_report(reports_, 0)) {
      const KeeperHello hello = {wire_version(), ready->report.isolation, ready->sender,
                                 ready->report.has_copies};
      host_.send(encode(hello));
    }
    for (;;) {
      // A system without descriptors of processes cannot report the end of one, so the process is
      // looked at now and then.
      constexpr int now_and_then_ms = 20;
      std::array<pollfd, 4> watched = {{{host_.descriptor(), POLLIN, 0},
                                        {plugin_, POLLIN, 0},
                                        {ended_, POLLIN, 0},
                                        {printed_, POLLIN, 0}}};
      ::poll(watched.data(), watched.size(), ended_ < 0 ? now_and_then_ms : -1);
      if (watched[3].revents) tell_words(false);
      if (watched[0].revents) from_host();
      if (watched[1].revents) from_plugin();
      if (has_ended()) end();
    }
  }

 private:
  bool has_ended() const {
    siginfo_t seen = {};
    const int got = ::waitid(P_PID, static_cast<id_t>(child_), &seen, WEXITED | WNOHANG | WNOWAIT);
    return got != 0 || seen.si_pid != 0;
  }

  void from_host() {
    told_ = 0;
    if (pass_on_all(host_.descriptor(), plugin_) == Passed::from_is_closed) leave();
  }

  void hear() {
    if (printed_ < 0 || read_what_is_there(printed_, words_)) return;
    ::close(printed_);
    printed_ = -1;
  }

  // Tells the text at once, because the host may end this process. If the plug-in floods it, only
  // what comes with a reply or at the end is told. The write does not wait, because the pipe of
  // the host holds more than this.
  void tell_words(bool is_last) {
    hear();
    constexpr std::size_t most_at_once = 8 * longest_printed;
    if (words_.empty() || (!is_last && told_ > most_at_once)) return;
    const std::string text = words_.take();
    told_ += text.size();
    [[maybe_unused]] const ssize_t done = ::write(printed_descriptor, text.data(), text.size());
  }

  void from_plugin() {
    tell_words(true);
    const Passed passed = pass_on_all(plugin_, host_.descriptor());
    if (passed == Passed::to_is_closed) leave();
    if (passed != Passed::from_is_closed) return;
    ::shutdown(host_.descriptor(), SHUT_WR);
    ::close(plugin_);
    plugin_ = -1;  // poll ignores a negative descriptor
  }

  // Called when the host is gone.
  void leave() {
    if (plugin_ >= 0) ::shutdown(plugin_, SHUT_WR);
    pollfd end = {ended_, POLLIN, 0};
    ::poll(&end, 1, last_words_ms);
    if (!has_ended()) ::_exit(EXIT_SUCCESS);  // this ends the processes of the plug-in too
    this->end();
  }

  [[noreturn]] void end() {
    tell_words(true);
    if (plugin_ >= 0) pass_on_all(plugin_, host_.descriptor());  // the last reply of the plug-in
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    if (const auto last = receive_report(reports_, MSG_DONTWAIT)) status = last->report.status;
    end_like(status);
  }

  Channel host_;
  int plugin_, reports_, printed_;
  LastWords words_;
  std::size_t told_ = 0;  // bytes of the text that were told since the host's last message
  pid_t child_;
  int ended_;
};

}  // namespace

void keep(Channel host, const KeptPlugin& kept, const std::function<int(Channel)>& serve) {
  const pid_t parent = ::getppid();
  // This is asked before anything else may be opened under this number.
  const bool is_silent =
      kept.mode != IsolationMode::none && ::fcntl(printed_descriptor, F_GETFD) >= 0;
  std::array<int, 2> channel, reports;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channel.data()) != 0 ||
      ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, reports.data()) != 0) {
    ::_exit(EXIT_FAILURE);
  }
  std::array<int, 2> printed = {-1, -1};
  if (is_silent && ::pipe2(printed.data(), O_CLOEXEC) != 0) ::_exit(EXIT_FAILURE);
  if (is_silent) ::fcntl(printed[0], F_SETFL, O_NONBLOCK);
  const int yes = 1;
  ::setsockopt(reports[0], SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes);
  if (kept.mode != IsolationMode::none) become_limitable();
  const bool in_new_world = kept.mode != IsolationMode::none && begin_new_world();
  // Entering a new world changes the rights of the process, and the system then forgets this
  // setting. So it is made again; the host may have died by now.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_SUCCESS);
  const ChildEnds ends = {channel[1], reports[1], printed[1]};
  const pid_t child = ::fork();
  if (child == 0) {
    if (in_new_world) begin_with_plugin(kept, ends, serve);
    become_plugin(kept, ends, false, false, serve);
  }
  if (child < 0) ::_exit(EXIT_FAILURE);
  ::close(channel[1]);
  ::close(reports[1]);
  if (is_silent) ::close(printed[1]);
  Keeper(std::move(host), channel[0], reports[0], printed[0], child).run();
}

}  // namespace assay::properties
