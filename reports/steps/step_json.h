// JSON of `check`, schema assay-check/1 (documented in reports/check/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/step_result.h"
#include "reports/steps/step_text.h"

namespace assay::reports {

nlohmann::ordered_json to_json(const detector::TimeEnclosure& time);
// With names of the bodies its triangles are named by them, too.
nlohmann::ordered_json to_json(const detector::PairContact& contact,
                               const properties::BodyNames& bodies = {});
nlohmann::ordered_json to_json(const properties::StepDiff& diff,
                               const properties::BodyNames& bodies = {});

// One entry of `steps`, without a second opinion. `oracle` is null if it was not asked.
nlohmann::ordered_json step_json(const detector::StepResult& result, const JudgedByOracle* oracle,
                                 const properties::BodyNames& bodies);

}  // namespace assay::reports
