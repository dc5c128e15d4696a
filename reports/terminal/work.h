// The work of a verb: its exit codes, and the one line on stderr if it must give up; the limits of
// time and memory that a user sets; lines that show the progress of long work; and its files.
#pragma once

#include <boost/outcome/try.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <new>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/step_types.h"

namespace assay::reports {

// The exit codes of every verb. If several apply, the first of 2, 4, 1, 3, 5, 0 is used.
enum ExitCode : int {
  exit_holds = 0,      // all claims hold
  exit_defect = 1,     // detector and oracle (or truth, or expected facts) differ
  exit_usage = 2,      // usage or input error: only one line on stderr
  exit_undecided = 3,  // a step ended at a limit
  exit_unsound = 4,    // the harness failed a check of itself
  exit_collision = 5,  // with --fail-on-collision: a collision, and no defect
};

using corpus::Expected;
using corpus::Problem;
using corpus::ProblemKind;
namespace outcome = boost::outcome_v2;

// Prints "assay: LINE" on stderr, with control characters replaced, and cut at 1,000 bytes. Returns
// exit_usage. Never throws, even if stderr cannot be written.
int refuse(const std::string& line) noexcept;
// Refuses with the problem's line.
int refuse(const Problem& problem) noexcept;

// Returns whether all output reached stdout; if not, says so on stderr.
bool output_was_written() noexcept;

// Makes SIGINT and SIGTERM print `line` and end the program with `code`. Meant for work that stores
// its results and can be continued later. REQUIRES that no thread has started yet; threads started
// later leave the two signals to the program. Workers are not affected: a ctrl-C in a terminal does
// not reach them, and they block no signal (properties/worker/child_process.h). A signal that is
// ignored stays ignored.
void end_when_interrupted(const std::string& line, int code);

// Limits of work. Work that reaches a limit ends as `undecided`. Time is processor time, so that
// the decision does not depend on the load of the machine.
class Limits {
 public:
  // Limits the processor time from now on, of all threads of this process together (two working
  // threads use it up in half the time on the wall), and the resident memory of this process.
  Limits(std::optional<double> seconds, std::optional<std::uint64_t> bytes);

  // Returns whether a limit is reached. Asks the clock and the system, in less than 1 us if only
  // time is limited, and remembers the first limit reached.
  bool exceeded();
  // Returns "time limit of 10 s" or "memory limit of 512 MiB"; empty before a limit was reached.
  const std::string& limit_text() const { return limit_text_; }
  // Returns whether the limit reached is a limit of memory, the user's or the machine's.
  bool is_out_of_memory() const { return is_out_of_memory_; }
  // Notes that an allocation failed.
  void memory_failed();

  detector::StopFunction stop_function();

  // While a Pause exists, the time limit does not run.
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
  std::string limit_text_;
  bool is_out_of_memory_ = false;
};

// Returns the seconds of the wall clock since `begin`.
inline double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

template <class Answer>
struct TimedAnswer {
  Answer answer;
  double milliseconds = 0;  // wall clock
};

// Returns the answer of `ask`, or an empty answer if memory runs out, with the time that `ask`
// took.
template <class Ask>
auto answer_in(Limits& limits, const Ask& ask) {
  const auto begin = std::chrono::steady_clock::now();
  TimedAnswer<decltype(ask())> answer;
  try {
    answer.answer = ask();
  } catch (const std::bad_alloc&) {
    limits.memory_failed();
  }
  answer.milliseconds = 1e3 * seconds_since(begin);
  return answer;
}

// Return the resident memory of this process, and the most that it ever was.
std::uint64_t resident_bytes();
std::uint64_t peak_resident_bytes();

// Shows a line of text on `out`. On a terminal the line is rewritten in place; elsewhere, such as
// in a log, a line is added now and then, at intervals of at least `between_lines`.
class PlainProgress {
 public:
  explicit PlainProgress(std::string title, std::FILE* out = stdout,
                         std::chrono::seconds between_lines = std::chrono::seconds(20));
  ~PlainProgress() { finish(); }
  PlainProgress(const PlainProgress&) = delete;
  PlainProgress& operator=(const PlainProgress&) = delete;

  // Returns whether the last text was shown long enough ago: 0.2 s on a terminal.
  bool is_due() const;
  // Shows the text if is_due().
  void show(const std::string& text);
  // Removes the line from a terminal. Further calls are allowed; the destructor calls it too.
  void finish();

 private:
  std::FILE* const out_;
  const bool on_terminal_;
  const std::chrono::steady_clock::duration between_;
  bool has_line_ = false;
  std::string title_;
  std::chrono::steady_clock::time_point last_;
};

// Shows on stderr the phase of the work, and the seconds that the whole work has taken so far.
class Progress {
 public:
  explicit Progress(std::string title,
                    std::chrono::seconds between_lines = std::chrono::seconds(60));

  void phase(std::string name);
  // Shows a line if one is due. A call that shows no line is cheap.
  void tick();
  void finish() { line_.finish(); }

 private:
  PlainProgress line_;
  std::string phase_;
  std::chrono::steady_clock::time_point begin_;
};

// Writes the files of a verb: whole, or not at all.

// Checks that a file can be written at each of these paths (empty: no file is wanted). Fails for a
// folder, a device, one of the inputs, a file that is named twice, and a place without permission.
// Called before the work, so that no work is lost.
Expected<void> may_write(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs = {});

// Makes the folder if it does not exist (empty: no folder is wanted), and checks that these files
// in it can be written. Called before the work, too.
Expected<void> may_fill(const std::string& folder, const std::vector<std::string>& files = {});

// Writes the whole file, or leaves the old one as it is.
Expected<void> write_text_file(const std::string& path, const std::string& text);
// Writes JSON like write_text_file, indented by one; bytes that are no UTF-8 are replaced.
Expected<void> write_json_file(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace assay::reports
