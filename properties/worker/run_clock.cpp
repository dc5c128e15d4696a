#include "properties/worker/run_clock.h"

#include <sys/resource.h>
#include <time.h>

namespace assay::properties {
namespace {

double processor_seconds_here() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::uint64_t peak_bytes_here() {
  rusage use = {};
  ::getrusage(RUSAGE_SELF, &use);
  constexpr std::uint64_t bytes_a_kilobyte = 1024;
  return bytes_a_kilobyte * static_cast<std::uint64_t>(use.ru_maxrss);
}

}  // namespace

RunClock::RunClock(bool is_on) : is_on_(is_on) { begin(); }

double RunClock::lap() {
  const double before = last_;
  last_ = processor_seconds_here();
  return last_ - before;
}

void RunClock::begin() {
  if (is_on_) lap();
}

void RunClock::created() {
  if (is_on_) times_.create = lap();
}

void RunClock::answered() {
  if (is_on_) times_.steps.push_back(lap());
}

std::optional<RunTimes> RunClock::take() {
  if (!is_on_) return std::nullopt;
  times_.peak_bytes = peak_bytes_here();
  return std::move(times_);
}

}  // namespace assay::properties
