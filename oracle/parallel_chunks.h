// Work on a range of items by chunks, in several threads, with a way to stop.
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
  // True once the stop function has said so. Cheap enough for every query.
  bool stopped();
  // What it said last, without asking.
  bool was_stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  using Clock = std::chrono::steady_clock;
  detector::StopFunction stop_;
  std::mutex asking_;
  std::atomic<bool> stopped_ = false;
  std::atomic<Clock::rep> next_;
};

// Calls work(begin, end, worker) for consecutive chunks that cover [0, count), with worker in
// [0, jobs) telling the calls of one thread apart; `jobs` below 1 counts as 1. Chunks are taken in
// order by whichever thread is free. No further chunk is begun once the gate has stopped; work
// asks the gate itself inside long chunks. The first exception of any thread is thrown again here.
using ChunkWork = std::function<void(std::size_t begin, std::size_t end, int worker)>;
void for_each_chunk(std::size_t count, std::size_t chunk, int jobs, StopGate& gate,
                    const ChunkWork& work);

}  // namespace assay::oracle
