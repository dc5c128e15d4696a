// Runs a case of the corpus through detector and oracle, and compares both with its expected
// facts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"

namespace assay::properties {

struct CheckedCase : Examined {
  std::vector<std::string> failed = {};  // one line for each fact that does not hold
};

// Runs the case in this process with its own options (case_options.h); `culling` and `arithmetic`
// replace the case's if they are given. The case's view primitive is used if the culling uses
// views.
//
// The facts compared are: refusal or answer, first time, pair set (of detector and oracle), view
// signs (of the detector if it tested the triangle, always of the oracle), and the agreement of
// detector and oracle. The detector's answer, pairs and signs are held to what its arithmetic
// claims.
CheckedCase check_case(const corpus::Case& c, std::optional<detector::Culling> culling = {},
                       int jobs = 1, std::optional<detector::Arithmetic> arithmetic = {});

}  // namespace assay::properties
