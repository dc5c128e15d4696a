#include "properties/worker/isolation/own_limits.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace assay::properties {
namespace {

// A lower limit stays.
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

}  // namespace

bool limit_memory(std::uint64_t bytes) { return bytes == 0 || limit(RLIMIT_AS, bytes); }

bool limit_plugin(std::uint64_t bytes) {
  constexpr rlim_t most_processes = 512;
  struct sysinfo seen = {};
  ::sysinfo(&seen);
  stop_being_root();
  ::signal(SIGXFSZ, SIG_IGN);
  return limit(RLIMIT_NPROC, most_processes + seen.procs) &&
         (bytes == 0 || limit(RLIMIT_FSIZE, bytes)) && limit_memory(bytes);
}

// If the system has no such file, or keeps it closed, it chooses by itself which process to end.
void end_first_without_memory() {
  constexpr std::string_view first_of_all = "1000";
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const auto written = ::write(file, first_of_all.data(), first_of_all.size());
  ::close(file);
}

}  // namespace assay::properties
