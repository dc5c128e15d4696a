#include "reports/terminal/limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace assay::reports {

namespace {

// The processor time of all threads of this process, including those that ended.
double processor_seconds() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + nanosecond * static_cast<double>(now.tv_nsec);
}

}  // namespace

Limits::Limits(std::optional<double> seconds, std::optional<std::uint64_t> bytes)
    : seconds_(seconds), bytes_(bytes), begin_(processor_seconds()) {}

bool Limits::exceeded() {
  if (!reached_.empty()) return true;
  if (seconds_ && processor_seconds() - begin_ >= *seconds_) {
    reached_ = fmt::format("time limit of {} s", *seconds_);
  }
  if (reached_.empty() && bytes_ && resident_bytes() >= *bytes_) {
    constexpr std::uint64_t mebibyte = 1 << 20;
    reached_ = fmt::format("memory limit of {} MiB", *bytes_ / mebibyte);
    is_out_of_memory_ = true;
  }
  return !reached_.empty();
}

void Limits::memory_failed() {
  if (!reached_.empty()) return;
  reached_ = "memory of this machine";
  is_out_of_memory_ = true;
}

detector::StopFunction Limits::stop_function() {
  return [this] { return exceeded(); };
}

Limits::Pause::Pause(Limits& limits) : limits_(limits), begin_(processor_seconds()) {}

Limits::Pause::~Pause() { limits_.begin_ += processor_seconds() - begin_; }

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total_pages = 0, resident_pages = 0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::uint64_t kibibyte = 1024;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte;
}

}  // namespace assay::reports
