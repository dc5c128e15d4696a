// Why a verb cannot go on, and the one line on stderr that says so.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <boost/outcome/success_failure.hpp>
#include <string>

#include "properties/problem.h"
#include "reports/terminal/exit_code.h"

namespace assay::reports {

// The line that the user reads. The other rooms fail with named problems; here each of them becomes
// its line, and nothing else is asked of it any more.
struct Refusal {
  std::string line;
  int code = exit_usage;

  Refusal() = default;
  explicit Refusal(std::string text) : line(std::move(text)) {}
  // Of corpus::Problem, detector::Problem and their like.
  template <class Problem>
  requires requires(const Problem& problem) { std::string(problem.message); }
  explicit Refusal(const Problem& problem) : line(problem.message) {}
  // What was stored is not what is read back: the harness cannot vouch for anything then.
  explicit Refusal(const properties::Problem& problem)
      : line(problem.message),
        code(problem.kind == properties::ProblemKind::not_as_stored ? exit_unsound : exit_usage) {}
};

namespace outcome = boost::outcome_v2;

// A value or the reason why there is none. Asking for the side that is not there ends the program.
template <class T>
using Expected = outcome::basic_result<T, Refusal, outcome::policy::terminate>;

// "assay: LINE", control characters replaced, cut at 1,000 bytes; returns exit_usage. Never throws,
// whatever stderr is.
int refuse(const std::string& line) noexcept;
// The same; returns the refusal's own code.
inline int refuse(const Refusal& refusal) noexcept {
  refuse(refusal.line);
  return refusal.code;
}

// Whether all that was printed reached stdout; says so on stderr when not.
bool output_was_written() noexcept;

}  // namespace assay::reports
