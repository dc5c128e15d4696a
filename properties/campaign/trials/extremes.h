// How far the cases go on which a detector is tried. Beyond that nothing is known of it.
#pragma once

#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/campaign/ledger/record.h"

namespace assay::properties {

// The extremes of a case whose steps the oracle judged so. Costs O(N + M), and compares each frame
// with one other. REQUIRES triangles of which a detector can be made.
Extremes extremes_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth);

// The places in steps_of(c) of the steps that do not go on from a committed one.
std::vector<std::size_t> new_starts(const corpus::Case& c);

}  // namespace assay::properties
