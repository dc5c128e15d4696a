// JSON of `check`, schema assay-check/1 (documented in reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

nlohmann::ordered_json to_json(const detector::TimeEnclosure& time);
nlohmann::ordered_json to_json(const detector::PairContact& contact);
nlohmann::ordered_json to_json(const properties::StepDiff& diff);

// One entry of `steps`, without a second opinion. judgement and diff are null if no oracle was
// asked.
nlohmann::ordered_json step_json(const detector::StepResult& result,
                                 const oracle::StepJudgement* judgement, double oracle_ms,
                                 const properties::StepDiff* diff);

}  // namespace assay::reports
