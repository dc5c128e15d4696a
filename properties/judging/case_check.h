// Runs a case of the corpus through detector and oracle, and compares both with its expected
// facts.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/judging/agreement.h"
#include "properties/judging/case_options.h"

namespace assay::properties {

struct CaseStepReport {
  detector::StepResult result;
  oracle::StepJudgement judgement;
  StepDiff diff;
};

struct CaseReport {
  Outcome outcome = Outcome::holds;
  std::vector<std::string> failed;  // one line for each fact that does not hold
  std::vector<CaseStepReport> steps;
};

// Runs the case with its own options (case_options.h); `culling` and `arithmetic` replace the
// case's if they are given. The case's view primitive is used if the culling uses views.
//
// The facts compared are: refusal or answer, first time, pair set (of detector and oracle), view
// signs (of the detector if it tested the triangle, always of the oracle), and the agreement of
// detector and oracle. The detector's answer, pairs and signs are held to what its arithmetic
// claims.
CaseReport check_case(const corpus::Case& c, std::optional<detector::Culling> culling = {},
                      int jobs = 1, std::optional<detector::Arithmetic> arithmetic = {});

}  // namespace assay::properties
