// Asks a stop function after every so much work: often enough to end in time, too seldom to cost.
//
// The unit of work is what a box test costs, about 5 ns; callers count roughly. The function may
// ask the system how much memory there is, which takes 10 us. Once it has asked for an end it is
// not asked again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class Workers;  // parallel/workers.h

// Of work that nobody wants to end.
inline const StopFunction never_stops;

class PacedStop {
 public:
  // A millisecond: a tenth of what a stop may be late, for work is counted roughly.
  static constexpr std::uint64_t usual_interval = 200'000;

  explicit PacedStop(const StopFunction& stop, std::uint64_t interval = usual_interval)
      : stop_(stop), interval_(interval) {}
  // Of work that the workers share (parallel/for_all.h); one thread asks for all of them.
  PacedStop(const StopFunction& stop, const Workers& workers)
      : stop_(stop), workers_(&workers), interval_(usual_interval) {}

  // Whether to end: asks when as much work was done since it last asked.
  bool after(std::uint64_t work) {
    if (stopped_) return true;
    done_ += work;
    return done_ >= interval_ && now();
  }
  // Asks in any case.
  bool now() {
    done_ = 0;
    return stopped_ = stopped_ || (stop_ && stop_());
  }
  bool stopped() const { return stopped_; }

  // With the same workers, and never stopped.
  PacedStop unasked() const {
    PacedStop pace(never_stops, usual_interval);
    pace.workers_ = workers_;
    return pace;
  }

  const StopFunction& stop() const { return stop_; }
  const Workers* workers() const { return workers_; }  // null: one thread does it all

 private:
  const StopFunction& stop_;
  const Workers* workers_ = nullptr;
  std::uint64_t interval_, done_ = 0;
  bool stopped_ = false;
};

// body(i) for i = 0 .. count - 1, each so much work. The loop is cut into pieces, so that asking
// costs the body nothing. False when it was ended in between; without a pace it never is.
template <class Body>
bool for_each_paced(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, Body body) {
  constexpr std::size_t of_a_piece = 1024;
  for (std::size_t begin = 0; begin < count;) {
    const std::size_t end = begin + std::min(of_a_piece, count - begin);
    const std::uint64_t work = (end - begin) * work_of_each;
    for (; begin < end; ++begin) body(begin);
    if (pace && pace->after(work)) return false;
  }
  return true;
}
template <class Body>
bool for_each_paced(std::size_t count, std::uint64_t work_of_each, PacedStop& pace, Body body) {
  return for_each_paced(count, work_of_each, &pace, body);
}

}  // namespace assay::detector
