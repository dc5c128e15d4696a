#include "properties/worker/isolation/memory_limit.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

namespace assay::properties {

bool limit_memory(std::uint64_t bytes) {
  rlimit limit = {};
  if (bytes == 0) return true;
  if (::getrlimit(RLIMIT_AS, &limit) != 0) return false;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, bytes);
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, bytes);
  return ::setrlimit(RLIMIT_AS, &limit) == 0;
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
