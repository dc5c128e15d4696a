// What a run of `check` comes to: its last line, its word in the report, its exit code.
#pragma once

#include <optional>
#include <string>

#include "detector/mesh/step_types.h"
#include "properties/campaign/gates/not_judged.h"

namespace assay::reports {

struct CheckOutcome {
  bool is_judged = true;  // the oracle judged it
  bool defect = false, undecided = false;
  bool unsound = false;       // a second opinion contradicts the oracle
  bool facts_differ = false;  // expected facts of a case file do not hold
  bool judged_by_claims = false;
  bool has_answers = true;  // false: a library of candidates alone
  std::string ended;        // how a plug-in's run ended; empty: it went through
  std::string limit_reached;
  // Only for a plug-in: the claims that hold, those of which nothing is known, and what the
  // plug-in does whatever it claims.
  std::vector<std::string> held;
  std::vector<properties::NotJudged> not_judged;
  properties::StepMeasures measures;
  std::optional<std::size_t> collision_step;  // the first step with a collision, counted from 0
  detector::TimeEnclosure collision_time;

  // The last lines of what `check` prints, each with its end of line.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
};

}  // namespace assay::reports
