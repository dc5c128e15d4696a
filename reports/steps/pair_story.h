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
// With a separation the boxes are grown by it, and of a pair that stays farther apart the oracle is
// asked for the least distance. Runs the built-in detector in this process. REQUIRES a truth of
// what is asked with these options (properties/claims/claims.h, contract_of).
std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
