#include "properties/worker/run_clock.h"

#include <time.h>

namespace assay::properties {
namespace {

double processor_seconds_here() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
  return is_on_ ? std::optional(std::move(times_)) : std::nullopt;
}

}  // namespace assay::properties
