#include "reports/bench/interleave.h"

#include <malloc.h>
#include <time.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <fstream>
#include <string>

#include "properties/worker/child_process.h"

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

namespace {

// Reads a line such as "VmHWM:     1234 kB" of /proc/self/status. The result is in bytes.
std::optional<double> status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kilobytes = 0;
    if (word == name && status >> kilobytes) return 1024 * kilobytes;
  }
  return std::nullopt;
}

// Called in the child: from here on the highest resident memory is counted anew, beginning with
// what is resident now.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  constexpr const char* reset_peak = "5";
  file << reset_peak << std::flush;
  return static_cast<bool>(file);
}

double measured_in_child(const std::function<void()>& work, const std::function<void()>& prepare) {
  constexpr double unknown = -1;
  // This is malloc's own value before it has freed anything. Set by hand, it stays.
  constexpr int smallest_given_back = 128 * 1024;
  mallopt(M_MMAP_THRESHOLD, smallest_given_back);
  if (prepare) prepare();
  malloc_trim(0);
  if (!forget_peak()) return unknown;
  const auto before = status_bytes("VmRSS:"), file_before = status_bytes("RssFile:");
  work();
  const auto peak = status_bytes("VmHWM:"), file_after = status_bytes("RssFile:");
  if (!before || !peak || !file_before || !file_after) return unknown;
  // The child touched pages of the program itself for the first time. They do not belong to the
  // work, and none of them goes away in between.
  const double of_the_program = *file_after - *file_before;
  return *peak - *before - of_the_program;
}

}  // namespace

std::optional<double> peak_memory_of(const std::function<void()>& work,
                                     const std::function<void()>& prepare) {
  malloc_trim(0);
  try {
    const auto run = properties::in_a_copy([&](const properties::Say& say) {
      say(std::to_string(std::llround(measured_in_child(work, prepare))));
    });
    const double bytes = std::stod(run.said);
    return bytes >= 0 ? std::optional(bytes) : std::nullopt;
  } catch (const std::exception&) {  // the work threw, or ended its process without a word
    return std::nullopt;
  }
}

}  // namespace assay::reports
