#include "properties/worker/isolation/plugin_child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "properties/worker/isolation/call_filter.h"
#include "properties/worker/isolation/file_fence.h"
#include "properties/worker/isolation/memory_limit.h"
#include "properties/worker/isolation/namespaces.h"

namespace assay::properties {
namespace {

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

}  // namespace

void become_plugin(const KeptPlugin& kept, const ChildEnds& ends, bool in_new_world,
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

void begin_with_plugin(const KeptPlugin& kept, const ChildEnds& ends,
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

}  // namespace assay::properties
