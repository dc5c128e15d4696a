// Asks a stop function once in each interval of work: often enough to end in time, and so seldom
// that asking costs next to nothing.
//
// The unit of work is the cost of a box test, about 5 ns. Callers count their work roughly. A stop
// function may ask the system how much memory there is, which takes 10 us. Once it has returned
// true it is not asked again. The result of stopped work must not be used:
//
//   PacedStop pace(stop);  // a StopFunction, which has to outlive it
//   const Topology mesh = make_topology(triangles, positions.rows(), pace);
//   if (!pace.stopped()) use(mesh);
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class Workers;  // parallel/workers.h

// The stop function for work that nobody wants to end.
inline const StopFunction never_stops;

class PacedStop {
 public:
  // About a millisecond of work. That is a tenth of the time by which a stop may be late, because
  // work is counted roughly.
  static constexpr std::uint64_t usual_interval = 200'000;

  explicit PacedStop(const StopFunction& stop, std::uint64_t interval = usual_interval)
      : stop_(stop), interval_(interval) {}
  // The same, but it also ends once more than `most` work was done.
  PacedStop(const StopFunction& stop, std::uint64_t interval, double most)
      : stop_(stop), interval_(interval), most_(most) {}
  // Serves work that the workers share (for_all.h). One thread asks for all of them.
  PacedStop(const StopFunction& stop, const Workers& workers)
      : stop_(stop), workers_(&workers), interval_(usual_interval) {}

  // Adds `work` to what was done, and says whether to end. It asks the stop function if an
  // interval of work was done since it last asked.
  bool after(std::uint64_t work) {
    if (stopped_) return true;
    done_ += work;
    return done_ >= interval_ && now();
  }
  // Asks the stop function at once, however little work was done, and says whether to end.
  bool now() {
    spent_ += std::exchange(done_, 0);
    return stopped_ = stopped_ || static_cast<double>(spent_) > most_ || (stop_ && stop_());
  }
  // Returns the work that was done. REQUIRES that no workers shared it.
  double spent() const { return static_cast<double>(spent_ + done_); }
  bool stopped() const { return stopped_; }

  // Returns a pace with the same workers that asks nobody and is never stopped.
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
  std::uint64_t interval_, done_ = 0, spent_ = 0;
  double most_ = std::numeric_limits<double>::infinity();
  bool stopped_ = false;
};

// Calls body(i) for i = 0 .. count - 1, and counts work_of_each for each call. The loop runs in
// pieces, and the pace is asked only between pieces, so that asking does not slow the body down.
// Returns false if the pace was stopped after some piece. Without a pace (null) all calls are made.
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
