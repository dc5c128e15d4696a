// Whether two results of a step are the same, to the last bit.
#pragma once

#include <string>

#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::properties {

// Names the first field that differs; empty if none does. Wall-clock times are not looked at.
std::string difference(const detector::StepResult& a, const detector::StepResult& b);

}  // namespace assay::properties
