// JSON of `check`, schema assay-check/1 (documented in reports/README.md), and its writing.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "properties/judging/agreement.h"

namespace assay::reports {

nlohmann::ordered_json to_json(const detector::TimeEnclosure& time);
nlohmann::ordered_json to_json(const detector::PairContact& contact);
nlohmann::ordered_json to_json(const properties::StepDiff& diff);

// One entry of `steps`, without a second opinion. judgement and diff are null when no oracle was
// asked.
nlohmann::ordered_json step_json(const detector::StepResult& result,
                                 const oracle::StepJudgement* judgement, double oracle_ms,
                                 const properties::StepDiff* diff);

// A line for the user when a file could not be written at `path` (empty: no file is wanted), or
// should not: it is a device, or one of the inputs.
std::optional<std::string> cannot_write(const std::string& path,
                                        const std::vector<std::string>& inputs);

// Writes a whole file or leaves the old one: a line for the user when that fails.
std::optional<std::string> write_text_file(const std::string& path, const std::string& text);
// The same of JSON, indented by one; bytes that are no UTF-8 are replaced.
std::optional<std::string> write_json_file(const std::string& path,
                                           const nlohmann::ordered_json& json);

}  // namespace assay::reports
