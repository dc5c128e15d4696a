// assay-worker runs detectors on the cases that its host sends, until the host closes the channel.
// It holds the built-in detector and, if a library is named, a plug-in. It never holds the oracle.
#include <fcntl.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "properties/words.h"
#include "properties/worker/messages.h"
#include "properties/worker/plugin/judged_library.h"
#include "properties/worker/plugin/plugin_host.h"

namespace {

using namespace assay::properties;

constexpr int exit_usage = 2;

// The limits that this process sets for itself before it loads a plug-in.

// Sets a limit. A lower one that is set already stays.
bool limit(__rlimit_resource resource, rlim_t most) {
  rlimit now = {};
  if (::getrlimit(resource, &now) != 0) return false;
  now = {std::min(now.rlim_cur, most), std::min(now.rlim_max, most)};
  return ::setrlimit(resource, &now) == 0;
}

void stop_being_root() {
  if (::getuid() != 0) return;
  constexpr uid_t nobody = 65534;  // by convention
  constexpr auto as_it_is = static_cast<uid_t>(-1);
  (void)!::setresuid(nobody, as_it_is, as_it_is);
  __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none = {};
  ::syscall(SYS_capset, &header, none.data());
}

// Limits the bytes of address space of this process and of each process that it starts; 0: no
// limit. A lower limit that the user has set stays. Returns false if the system refuses.
bool limit_memory(std::uint64_t bytes) { return bytes == 0 || limit(RLIMIT_AS, bytes); }

// Limits also the bytes of each file that this process writes, to the same number. A call that
// would write more fails, and does not end the process. Limits the processes and threads that it
// may start to 512 more than there are now, because under root the workers of all runs belong to
// one user.
//
// The system exempts root from the limit on processes, by the real user of a process and by its
// rights. So root becomes another real user here and gives up its rights; the user as whom files
// are opened stays the same. REQUIRES that this process has one thread.
bool limit_plugin(std::uint64_t bytes) {
  constexpr rlim_t most_processes = 512;
  struct sysinfo status = {};
  ::sysinfo(&status);
  stop_being_root();
  ::signal(SIGXFSZ, SIG_IGN);
  return limit(RLIMIT_NPROC, most_processes + status.procs) &&
         (bytes == 0 || limit(RLIMIT_FSIZE, bytes)) && limit_memory(bytes);
}

// Lets the system end this process, and those that it starts, before any other if the machine
// itself runs out of memory. Many processes together may take more than the machine has, although
// each keeps its limit. If the system has no such file, or keeps it closed, it chooses by itself
// which process to end.
void end_first_without_memory() {
  constexpr std::string_view first_of_all = "1000";
  const Descriptor file(::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC));
  [[maybe_unused]] const auto count = ::write(file, first_of_all.data(), first_of_all.size());
}

// Settles how this process lives and dies. It dies with its host (behind bwrap, which ends it,
// `host` is 0), and before its host if memory is short. It leaves no core file and prints nothing
// on stdout.
bool settle(std::uint64_t host) {
  if (host > 0 && ::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return false;
  // The host may have died before this took effect.
  if (host > 0 && static_cast<std::uint64_t>(::getppid()) != host) return false;
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  end_first_without_memory();
  return ::dup2(STDERR_FILENO, STDOUT_FILENO) >= 0;
}

// Gives code that is loaded from now on other hash seeds and other addresses (of the heap, and of
// mappings) than in a worker with another number. The memory stays taken.
void vary(std::uint64_t variation) {
  ::setenv("PYTHONHASHSEED", std::to_string(variation).c_str(), 1);
  constexpr std::size_t page = 4096, small = 16;
  if (variation == 0) return;
  [[maybe_unused]] static void* volatile of_heap = std::malloc(small * (variation % page + 1));
  ::mmap(nullptr, page * (variation % page + 1), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

struct LoadedPlugin {
  const char* library;
  std::uint32_t threads = 1;
  std::string name;  // as the user calls it
  bool asks_twice = false;
};

int serve(Channel channel, const LoadedPlugin* library) {
  Hello hello;
  hello.wire_version = wire_version();
  hello.description = {"built-in", "", claims_of({}), {}};
  std::optional<PluginHost> plugin;
  if (library) {
    auto host = PluginHost::open(library->library, library->threads, library->name);
    if (host) {
      plugin = std::move(host.value());
      plugin->ask_twice(library->asks_twice);
      hello.description = plugin->description();
    } else {
      hello.serves = false;
      hello.refusal = host.error().message;
    }
  }
  if (channel.send(encode(hello)) != Transfer::done) return 0;
  RunReply reply;
  try {
    std::string message;
    while (channel.receive(message) == Transfer::done) {
      RunRequest request;
      if (!decode(message, request)) return exit_usage;
      const auto& [number, cases, configurations] = request;
      reply.number = number;
      for (reply.place = 0; reply.place < cases.size() * configurations.size(); ++reply.place) {
        const auto& c = cases[reply.place / configurations.size()];
        const auto& configuration = configurations[reply.place % configurations.size()];
        reply.run = plugin ? plugin->run(c, configuration.is_timed) : run_case(c, configuration);
        if (channel.send(encode(reply)) != Transfer::done) return 0;
        if (reply.run.end == RunEnd::out_of_memory) return 0;
      }
    }
  } catch (const std::bad_alloc&) {
    // The host continues with a new worker.
    reply.run = out_of_memory();
    channel.send(encode(reply));
  }
  return 0;
}

}  // namespace

// Serves the host. The arguments are the descriptor of the channel, the process of the host (0
// behind bwrap) and a limit in bytes. For a plug-in these follow: the library, its scratch folder,
// its number of threads, the user's name for it (perhaps the word of a detector in Python), the
// number by which this worker differs from others, and 1 if each step is evaluated twice, else 0.
int main(int argc, char** argv) {
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  constexpr std::size_t built_in = 4, with_plugin = 10;
  if (words.size() == built_in || words.size() == with_plugin) {
    const auto channel = whole_number_of(words[1]), host = whole_number_of(words[2]),
               bytes = whole_number_of(words[3]);
    if (channel && host && bytes && settle(*host)) {
      Channel to_host(static_cast<int>(*channel));
      if (words.size() == built_in)
        return limit_memory(*bytes) ? serve(std::move(to_host), nullptr) : exit_usage;
      const auto threads = whole_number_of(words[6]), variation = whole_number_of(words[8]),
                 asks_twice = whole_number_of(words[9]);
      if (threads && variation && asks_twice) {
        vary(*variation);
        ::setenv("TMPDIR", words[5], 1);
        const LoadedPlugin plugin{words[4], static_cast<std::uint32_t>(*threads), words[7],
                                  *asks_twice != 0};
        if (const auto word = python_word_of(plugin.name))
          ::setenv(python_detector_variable, word->text().c_str(), 1);
        ::close_range(static_cast<unsigned>(*channel) + 1, ~0U, 0);  // left open by the host
        if (*host == 0) ::setsid();                                  // bwrap's cannot be seen here
        if (!limit_plugin(*bytes)) return exit_usage;
        // An exception that nobody catches ends the process as it would end any other.
        std::exit(serve(std::move(to_host), &plugin));
      }
    }
  }
  std::fputs("assay-worker: is started by assay, not by hand\n", stderr);
  return exit_usage;
}
