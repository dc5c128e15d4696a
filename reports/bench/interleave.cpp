#include "reports/bench/interleave.h"

#include <time.h>

#include <chrono>

namespace assay::reports {

double processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double ns_of(const std::function<void()>& work) {
  const double begin = processor_ns();
  work();
  return processor_ns() - begin;
}

double wall_ns_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
  return taken.count();
}

std::vector<std::vector<double>> interleave(int rounds,
                                            const std::vector<Measurement>& measurements) {
  const std::size_t count = measurements.size();
  for (const auto& measure : measurements) measure();
  std::vector<std::vector<double>> samples(count);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = round % 2 == 0 ? k : count - 1 - k;
      samples[i].push_back(measurements[i]());
    }
  }
  return samples;
}

}  // namespace assay::reports
