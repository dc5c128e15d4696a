// Why a pair of triangles was or was not tested.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "oracle/mesh/step.h"

namespace assay::reports {

// Tells for each step of the case: both signs, doubts, components, layers at the start by the
// oracle, whether the pair is in K, whether its moving boxes meet, and what the oracle says of it.
// Runs the built-in detector in this process.
std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
