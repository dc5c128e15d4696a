#include "oracle/parallel_chunks.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace assay::oracle {

namespace {

constexpr std::chrono::milliseconds time_between_questions{2};

}  // namespace

StopGate::StopGate(detector::StopFunction stop)
    : stop_(std::move(stop)), next_(Clock::time_point::min().time_since_epoch().count()) {}

bool StopGate::stopped() {
  if (was_stopped()) return true;
  if (!stop_) return false;
  const Clock::time_point now = Clock::now();
  if (now.time_since_epoch().count() < next_.load(std::memory_order_relaxed)) return false;
  const std::unique_lock lock(asking_, std::try_to_lock);
  if (!lock) return was_stopped();
  if (stop_()) stopped_.store(true, std::memory_order_relaxed);
  next_.store((Clock::now() + time_between_questions).time_since_epoch().count(),
              std::memory_order_relaxed);
  return was_stopped();
}

void for_each_chunk(std::size_t count, std::size_t chunk, int jobs, StopGate& gate,
                    const ChunkWork& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::mutex failure_lock;
  std::exception_ptr failure;
  auto run = [&](int worker) {
    try {
      while (!failed && !gate.stopped()) {
        const std::size_t begin = next.fetch_add(chunk);
        if (begin >= count) return;
        work(begin, std::min(begin + chunk, count), worker);
      }
    } catch (...) {
      const std::lock_guard guard(failure_lock);
      if (!failure) failure = std::current_exception();
      failed = true;
    }
  };
  const std::size_t chunks = (count + chunk - 1) / chunk;
  const auto threads = static_cast<int>(
      std::min(static_cast<std::size_t>(std::max(jobs, 1)), std::max<std::size_t>(chunks, 1)));
  {
    std::vector<std::jthread> helpers;
    for (int worker = 1; worker < threads; ++worker) helpers.emplace_back(run, worker);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace assay::oracle
