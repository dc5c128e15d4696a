// A user's stop function made fit for several threads. Only the thread that makes this object ever
// calls it, so it need not be prepared for other threads; they all hear of its answer.
#pragma once

#include <atomic>
#include <thread>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class SharedStop {
 public:
  // `stop` must outlive this object, and this object must outlive what function() returns.
  explicit SharedStop(const StopFunction& stop)
      : stop_(stop), caller_(std::this_thread::get_id()) {}

  // A stop function for all threads: true as soon as the user's function has returned true. Empty
  // if the user's function is.
  StopFunction function() {
    if (!stop_) return {};
    return [this] {
      if (is_stopped_.load(std::memory_order_relaxed)) return true;
      if (std::this_thread::get_id() != caller_ || !stop_()) return false;
      is_stopped_.store(true, std::memory_order_relaxed);
      return true;
    };
  }

 private:
  const StopFunction& stop_;
  const std::thread::id caller_;
  std::atomic<bool> is_stopped_ = false;
};

}  // namespace assay::detector
