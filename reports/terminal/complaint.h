// How a verb ends: its exit code, and the one line on stderr that says why it cannot go on.
#pragma once

#include <boost/outcome/try.hpp>
#include <string>

#include "corpus/problem.h"

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

using corpus::Expected;
using corpus::Problem;
using corpus::ProblemKind;
namespace outcome = boost::outcome_v2;

// Prints "assay: LINE" on stderr, with control characters replaced and cut at 1,000 bytes, and
// returns exit_usage. Never throws, whatever stderr is.
int refuse(const std::string& line) noexcept;
// The same for the problem's line.
int refuse(const Problem& problem) noexcept;

// Whether all that was printed reached stdout; if not, says so on stderr.
bool output_was_written() noexcept;

// For work that keeps what it has and can go on later: from now on SIGINT and SIGTERM end the
// program with `code`, once `line` is printed. REQUIRES that no thread has started yet; threads
// started later leave the two signals to the program. Workers are not affected: a ctrl-C in a
// terminal does not reach them, and they block nothing (properties/worker/child_process.h). A
// signal that is ignored stays ignored.
void end_when_interrupted(const std::string& line, int code);

}  // namespace assay::reports
