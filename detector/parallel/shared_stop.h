// A stop function of which several threads hear, and which is asked by the calling thread alone: a
// user's function need not expect other threads.
#pragma once

#include <atomic>
#include <thread>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class SharedStop {
 public:
  // The function given must outlive this object, and this object what function() returns.
  explicit SharedStop(const StopFunction& stop)
      : stop_(stop), caller_(std::this_thread::get_id()) {}

  // True for all threads once the function has said so. Empty where that is.
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
