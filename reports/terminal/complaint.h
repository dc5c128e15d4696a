// Why a verb cannot go on, and the one line on stderr that says so.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <string>

#include "properties/problem.h"
#include "reports/terminal/exit_code.h"

namespace assay::reports {

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

}  // namespace assay::reports
