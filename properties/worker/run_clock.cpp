#include "properties/worker/run_clock.h"

#include <time.h>

#include <fstream>
#include <string>

namespace assay::properties {
namespace {

double processor_seconds_here() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// This does not use getrusage(), because what that tells outlives exec(), and so includes the
// memory of the process that started this one.
std::uint64_t peak_bytes_here() {
  constexpr std::uint64_t bytes_a_kilobyte = 1024;
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return bytes_a_kilobyte * kilobytes;
  }
  return 0;
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
