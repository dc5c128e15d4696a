// What a run of `check` comes to: its last line, its word in the report, its exit code.
#pragma once

#include <optional>
#include <string>

#include "detector/mesh/step_types.h"

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
  std::size_t left_out_misses = 0;  // steps that only a plug-in's contract saves from being a miss
  std::optional<std::size_t> collision_step;  // the first, from 0
  detector::TimeEnclosure collision_time;

  // One line or two, each with its end.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
};

}  // namespace assay::reports
