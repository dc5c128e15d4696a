// Limits of time and memory that a user sets; work that reaches one ends as `undecided`. Time is
// processor time, so that what is decided does not depend on what else the machine does.
#pragma once

#include <chrono>
#include <cstdint>
#include <new>
#include <optional>
#include <string>

#include "detector/mesh/step_types.h"

namespace assay::reports {

class Limits {
 public:
  // Limits the processor time from now on, of all threads of this process together (two working
  // threads use it up in half the time on the wall), and the resident memory of this process.
  Limits(std::optional<double> seconds, std::optional<std::uint64_t> bytes);

  // Whether a limit is reached. Asks the clock and the system, in less than 1 us if only time is
  // limited, and remembers the first limit reached.
  bool exceeded();
  // "time limit of 10 s" or "memory limit of 512 MiB"; empty before a limit was reached.
  const std::string& reached() const { return reached_; }
  // Whether what was reached is a limit of memory, the user's or the machine's.
  bool is_out_of_memory() const { return is_out_of_memory_; }
  // Notes that an allocation failed.
  void memory_failed();

  detector::StopFunction stop_function();

  // What this process does while there is one of these takes none of the time.
  class Pause {
   public:
    explicit Pause(Limits& limits);
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    Limits& limits_;
    double begin_;
  };

 private:
  std::optional<double> seconds_;
  std::optional<std::uint64_t> bytes_;
  double begin_;  // processor seconds of this process
  std::string reached_;
  bool is_out_of_memory_ = false;
};

template <class Answer>
struct Timed {
  Answer answer;
  double milliseconds = 0;  // wall clock
};

// Returns what `ask` answers, or an empty answer if memory fails.
template <class Ask>
auto timed(Limits& limits, const Ask& ask) {
  const auto begin = std::chrono::steady_clock::now();
  Timed<decltype(ask())> timed;
  try {
    timed.answer = ask();
  } catch (const std::bad_alloc&) {
    limits.memory_failed();
  }
  timed.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return timed;
}

// Resident memory of this process, and the most that it ever was.
std::uint64_t resident_bytes();
std::uint64_t peak_resident_bytes();

}  // namespace assay::reports
