// Shares the work on a range of items out to several threads, chunk by chunk, with a way to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// Asks the caller's stop function every few milliseconds, from one thread at a time.
class StopGate {
 public:
  explicit StopGate(detector::StopFunction stop);
  // Returns whether the stop function has asked for an end. Asks it if it is time to ask again;
  // cheap enough to be called for every query.
  bool stopped();
  // Returns whether the stop function has asked for an end so far; does not ask it.
  bool was_stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  using Clock = std::chrono::steady_clock;
  detector::StopFunction stop_;
  std::mutex asking_;
  std::atomic<bool> stopped_ = false;
  std::atomic<Clock::rep> next_;
};

// Calls work(begin, end, worker) for consecutive chunks that cover [0, count); whichever thread is
// free takes the next chunk. `worker`, in [0, jobs), is the number of the calling thread; `jobs`
// below 1 counts as 1. Once the gate has stopped, no further chunk is begun; inside long chunks
// `work` has to ask the gate itself. If calls throw, the first exception is thrown again here.
using ChunkWork = std::function<void(std::size_t begin, std::size_t end, int worker)>;
void for_each_chunk(std::size_t count, std::size_t chunk, int jobs, StopGate& gate,
                    const ChunkWork& work);

}  // namespace assay::oracle
