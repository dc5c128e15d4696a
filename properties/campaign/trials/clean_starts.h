// Finds the cases for which Start::clean may be used, because what the caller then vouches for is
// true.
#pragma once

#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/campaign/trials/trial.h"

namespace assay::properties {

// Whether the oracle calls every triangle clean (L9, detector/README.md) in every step of the case
// that is a new start. True for closed meshes alone, because for others the answer depends on
// where the detector puts its apexes.
bool starts_clean(const corpus::Case& c);

// Whether trial `index` of a family vouches for the start of its case. That is done for the
// built-in detector, in every second one of the trials that may.
bool is_vouched_for(const DetectorUnderTest& detector, const corpus::Case& c, std::uint64_t index);

// The same configurations, with start clean in place of start verified.
std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations);

}  // namespace assay::properties
