#include "properties/worker/isolation/keeper.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "properties/worker/child_process.h"
#include "properties/worker/isolation/namespaces.h"
#include "properties/worker/isolation/plugin_child.h"
#include "properties/worker/isolation/printed_words.h"
#include "properties/worker/wire_fields.h"

namespace assay::properties {
namespace {

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
