// Calls a stop function once in each interval of work: often enough to stop in time, and so seldom
// that the calls cost next to nothing.
//
// The unit of work is the cost of a box test, about 5 ns. Callers count their work roughly. A stop
// function can take 10 us, for example if it asks the system how much memory is used. Once a stop
// function has returned true it is not called again. The result of stopped work must not be used:
//
//   PacedStop pace(stop);  // `stop` is a StopFunction that must outlive `pace`
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
  // About a millisecond of work. A stop may come ten milliseconds late; the interval is a tenth of
  // that, because work is counted roughly.
  static constexpr std::uint64_t usual_interval = 200'000;

  explicit PacedStop(const StopFunction& stop, std::uint64_t interval = usual_interval)
      : stop_(stop), interval_(interval) {}
  // Stops also when more than `most` work was done.
  PacedStop(const StopFunction& stop, std::uint64_t interval, double most)
      : stop_(stop), interval_(interval), most_(most) {}
  // Serves work that `workers` share (for_all.h). Only the calling thread calls the stop function.
  PacedStop(const StopFunction& stop, const Workers& workers)
      : stop_(stop), workers_(&workers), interval_(usual_interval) {}

  // Adds `work` to the work that was done, and returns whether to stop. Calls the stop function if
  // an interval of work was done since its last call.
  bool after(std::uint64_t work) {
    if (stopped_) return true;
    done_ += work;
    return done_ >= interval_ && now();
  }
  // Calls the stop function at once, however little work was done, and returns whether to stop.
  bool now() {
    spent_ += std::exchange(done_, 0);
    return stopped_ = stopped_ || static_cast<double>(spent_) > most_ || (stop_ && stop_());
  }
  // Returns the work that was done. REQUIRES that no workers shared it.
  double spent() const { return static_cast<double>(spent_ + done_); }
  bool stopped() const { return stopped_; }

  // Returns a pace with the same workers and without a stop function, so it is never stopped.
  PacedStop unasked() const {
    PacedStop pace(never_stops, usual_interval);
    pace.workers_ = workers_;
    return pace;
  }

  const StopFunction& stop() const { return stop_; }
  const Workers* workers() const { return workers_; }  // null: one thread does all work

 private:
  const StopFunction& stop_;
  const Workers* workers_ = nullptr;
  std::uint64_t interval_, done_ = 0, spent_ = 0;
  double most_ = std::numeric_limits<double>::infinity();
  bool stopped_ = false;
};

// Calls body(i) for i = 0 .. count - 1, and counts work_of_each for each call. The loop runs in
// pieces. Work is counted only between pieces, so that counting does not slow the loop down.
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
