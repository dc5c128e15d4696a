// What `check` prints of a step.
#pragma once

#include <optional>
#include <string>

#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

// One double where the enclosure is exact or its ends print alike at 9 digits, else both.
std::string time_text(const detector::TimeEnclosure& time);

// A line with the answer, then the sizes, counts and times, indented. judgement and diff are null
// when no oracle was asked. create_ms: of the detector, where it is to be told.
std::string step_text(std::size_t number, const detector::StepResult& result,
                      const oracle::StepJudgement* judgement, double oracle_ms,
                      const properties::StepDiff* diff, std::optional<double> create_ms = {});

}  // namespace assay::reports
