// Shares work among several threads.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace assay::properties {

// Calls `work` in this thread and in up to jobs - 1 other threads at the same time, and returns
// when all of these calls have returned. Each call must begin one piece of work after another until
// none is left, because the system may give fewer threads. If calls throw, rethrows the first
// exception.
inline void in_threads(int jobs, const std::function<void()>& work) {
  std::mutex mutex;
  std::exception_ptr first;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int j = 1; j < jobs; ++j) others.emplace_back(guarded);
    } catch (const std::system_error&) {
      // The system gives no further thread. This thread and `others` then do all of the work.
    }
    guarded();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace assay::properties
