// What a run of `check` comes to: its last line, its exit code, its report, and for a plug-in the
// claims that hold and what it does whatever it claims.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/gates/not_judged.h"
#include "reports/check/step_answers.h"

namespace assay::reports {

// What one claim of a plug-in came to.
struct ClaimResult {
  enum class State : std::uint8_t { holds, broken, undecided, not_judged };
  std::string claim;
  State state;
  std::string why;  // "first in step 3", "undecided", or why it is not judged
};

struct CheckOutcome {
  bool is_judged = true;  // the oracle judged it
  bool defect = false, undecided = false;
  bool unsound = false;       // a second opinion contradicts the oracle
  bool facts_differ = false;  // expected facts of a case file do not hold
  bool judged_by_claims = false;
  bool has_answers = true;  // false: a library of candidates alone
  std::string ended;        // how a plug-in's run ended; empty: it went through
  std::string limit_reached;
  std::string rest;       // of a mesh at rest, which bodies meet; empty where that is not known
  std::string unwritten;  // why a file that was asked for was not written
  std::vector<std::string> asked_again;  // what came of asking a plug-in about steps that are kept
  std::vector<std::string> lost;         // of the input
  std::map<properties::Claim, std::uint64_t> first_broken;  // of each claim: its step, from 0
  std::size_t judged_steps = 0;
  // Only for a plug-in: the claims that hold, those of which nothing is known, and what the
  // plug-in does whatever it claims.
  std::vector<std::string> held;
  std::vector<properties::NotJudged> not_judged;
  properties::StepMeasures measures;
  std::optional<std::size_t> collision_step;  // the first step with a collision, counted from 0
  detector::TimeEnclosure collision_time;
  // The first step in which the oracle finds a contact and there is no answer to be judged, when
  // that contact is, and what the detector gave instead.
  std::optional<std::size_t> unanswered_step;
  detector::TimeEnclosure unanswered_time;
  std::string unanswered_error;

  // Counts a judged step of a plug-in.
  void count(const properties::StepDiff& diff, const detector::StepResult& result);
  // What all of them come to. `steps_left_out` is the number of steps of the input that the
  // contract leaves out.
  void judge_claims(const properties::DetectorUnderTest& plugin, std::size_t steps_left_out);

  // In the order of claims, those that are not judged last. REQUIRES judge_claims.
  std::vector<ClaimResult> claim_results() const;
  // The last lines of what `check` prints, each with its end of line.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
  // The exit code, or the problem if a file was not written.
  Expected<int> end(bool fail_on_collision) const;
};

// The report of `check`, schema assay-check/1 (documented in reports/check/README.md). `steps`: an
// entry for each step that was judged (steps/step_report.h).
nlohmann::ordered_json check_report(const std::vector<std::string>& files,
                                    const detector::Topology& mesh, const StepAnswers& answers,
                                    const CheckOutcome& outcome, nlohmann::ordered_json steps);

}  // namespace assay::reports
