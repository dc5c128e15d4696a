// How a verb ends: its exit code, and the one line on stderr that says why it cannot go on.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <string>

#include "properties/problem.h"

namespace assay::reports {

// The exit codes of every verb. If several apply, the first of 2, 4, 1, 3, 5, 0 is used.
enum ExitCode : int {
  exit_holds = 0,      // all claims hold
  exit_defect = 1,     // detector and oracle (or truth, or expected facts) differ
  exit_usage = 2,      // usage or input error: one line on stderr, nothing else
  exit_undecided = 3,  // a step ended at a limit
  exit_unsound = 4,    // the harness failed a check of itself
  exit_collision = 5,  // with --fail-on-collision: agreement, and a collision
};

// The line that the user reads, and the exit code. The other rooms (detector, corpus, properties)
// fail with problems that have a kind and a message. A problem is made into a refusal here, and
// after that nobody asks for its kind.
struct Refusal {
  std::string line;
  int code = exit_usage;

  Refusal() = default;
  explicit Refusal(std::string text) : line(std::move(text)) {}
  // From corpus::Problem, detector::Problem and their like.
  template <class Problem>
  requires requires(const Problem& problem) { std::string(problem.message); }
  explicit Refusal(const Problem& problem) : line(problem.message) {}
  // If what is read back is not what was stored (not_as_stored), the harness cannot vouch for
  // anything.
  explicit Refusal(const properties::Problem& problem)
      : line(problem.message),
        code(problem.kind == properties::ProblemKind::not_as_stored ? exit_unsound : exit_usage) {}
};

namespace outcome = boost::outcome_v2;

// A value or the reason why there is none. Asking for the side that is not there ends the program.
template <class T>
using Expected = outcome::basic_result<T, Refusal, outcome::policy::terminate>;

// Prints "assay: LINE" on stderr, with control characters replaced and cut at 1,000 bytes, and
// returns exit_usage. Never throws, whatever stderr is.
int refuse(const std::string& line) noexcept;
// Prints the refusal's line in the same way, and returns its own code.
inline int refuse(const Refusal& refusal) noexcept {
  refuse(refusal.line);
  return refusal.code;
}

// Whether all that was printed reached stdout; if not, says so on stderr.
bool output_was_written() noexcept;

// For work that keeps what it has and can go on later: from now on SIGINT and SIGTERM end the
// program with `code`, once `line` is printed. REQUIRES that no thread has started yet; threads started later leave the two signals to the program.
// Workers are not affected: a ctrl-C in a terminal does not reach them, and they block nothing
// (properties/worker/child_process.h). A signal that is ignored stays ignored.
void end_when_interrupted(const std::string& line, int code);

}  // namespace assay::reports
