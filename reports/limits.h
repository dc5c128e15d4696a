// Limits of time and memory that a user sets; work that reaches one ends as `undecided`.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "detector/mesh/step_types.h"

namespace assay::reports {

class Limits {
 public:
  // seconds from now; bytes of resident memory of this process.
  Limits(std::optional<double> seconds, std::optional<std::uint64_t> bytes);

  // Asks the clock and the system; remembers the first limit reached.
  bool exceeded();
  // "time limit of 10 s" or "memory limit of 512 MiB"; empty before a limit was reached.
  const std::string& reached() const { return reached_; }
  // Notes that an allocation failed.
  void memory_failed();

  detector::StopFunction stop_function();

 private:
  std::optional<double> seconds_;
  std::optional<std::uint64_t> bytes_;
  std::chrono::steady_clock::time_point begin_;
  std::string reached_;
};

// Resident memory of this process, and the most that it ever was.
std::uint64_t resident_bytes();
std::uint64_t peak_resident_bytes();

}  // namespace assay::reports
