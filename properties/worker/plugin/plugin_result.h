// A plug-in's result as a StepResult.
#pragma once

#include <string>

#include "detector/options.h"
#include "detector/plugin/assay_detector.h"
#include "detector/step_result.h"

namespace assay::properties {

// Pairs a < b, ascending, each once with its least time ([0, 1] where none is stated). A result
// that breaks the header's rules is an error, and `problem` says which, in one line.
detector::StepResult step_result(const assay_result& raw, std::int32_t triangle_count,
                                 std::string& problem);

}  // namespace assay::properties
