// Adds the wall-clock time of a scope to a sum of milliseconds.
#pragma once

#include <chrono>

namespace assay::detector {

class Stopwatch {
 public:
  explicit Stopwatch(double& milliseconds) : total_(milliseconds) {}
  ~Stopwatch() {
    total_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_)
                  .count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace assay::detector
