// What a run of `check` comes to: its last line, its word in the report, its exit code.
#pragma once

#include <optional>
#include <string>

#include "detector/mesh/step_types.h"
#include "properties/campaign/gates/not_judged.h"

namespace assay::reports {

struct CheckOutcome {
  bool is_judged = true;  // by the oracle
  bool defect = false, undecided = false;
  bool unsound = false;       // a second opinion contradicts the oracle
  bool facts_differ = false;  // of a case file
  bool judged_by_claims = false;
  bool has_answers = true;  // false: of a library of candidates alone
  std::string ended;        // how a plug-in's run ended, where it did not go through
  std::string limit_reached;
  // Of a plug-in: claims that hold, those of which nothing is known, and what it does whatever it
  // claims.
  std::vector<std::string> held;
  std::vector<properties::NotJudged> not_judged;
  properties::StepMeasures measures;
  std::optional<std::size_t> collision_step;  // the first, from 0
  detector::TimeEnclosure collision_time;

  // Some lines, each with its end.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
};

}  // namespace assay::reports
