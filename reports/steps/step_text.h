// What `check` prints of a step.
#pragma once

#include <optional>
#include <string>

#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

// One double if the enclosure is exact or its ends look alike at 9 digits, else both ends.
std::string time_text(const detector::TimeEnclosure& time);

// What can be shown of a detector's work.
struct ShownWork {
  bool has_stages = true;     // view sets, counts, times and features: the built-in detector's
  bool reports_pairs = true;  // by its contract
  std::optional<double> create_ms;  // to be shown, if it is given
};

// A line with the answer, then the sizes, counts and times, indented, as far as they are to be
// shown. judgement and diff are null if no oracle was asked.
std::string step_text(std::size_t number, const detector::StepResult& result,
                      const oracle::StepJudgement* judgement, double oracle_ms,
                      const properties::StepDiff* diff, const ShownWork& shown);

}  // namespace assay::reports
