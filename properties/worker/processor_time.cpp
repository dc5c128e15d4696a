#include "properties/worker/processor_time.h"

#include <algorithm>

namespace assay::properties {

ProcessorTime::ProcessorTime(pid_t process, pid_t worker)
    : process_(process), worker_(worker > 0 ? worker : process) {
  clockid_t clock;
  if (::clock_getcpuclockid(worker_, &clock) == 0) clock_ = clock;
  begin_ = own_seconds();
}

double ProcessorTime::own_seconds() const {
  timespec now = {};
  if (!clock_ || ::clock_gettime(*clock_, &now) != 0) return begin_;
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + nanosecond * static_cast<double>(now.tv_nsec);
}

double ProcessorTime::seconds() const { return own_seconds() - begin_ + of_others_; }

double ProcessorTime::lap() {
  const double now = own_seconds();
  const double used = now - begin_ + of_others_;
  begin_ = now;
  of_others_before_.reset();
  of_others_ = 0;
  return used;
}

ProcessTree ProcessorTime::look() {
  const ProcessTree tree = look_at(process_, worker_);
  if (!of_others_before_) of_others_before_ = tree.descendant_seconds;
  // The sum falls if a process ends for which nobody waits, so the greatest value is kept.
  of_others_ = std::max(of_others_, tree.descendant_seconds - *of_others_before_);
  return tree;
}

}  // namespace assay::properties
