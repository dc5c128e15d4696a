// A case as a detector's contract has it. Both the detector and the oracle are given this case.
#pragma once

#include <optional>

#include "corpus/cases/case_file.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// The case with coordinates rounded, and without the steps that the contract leaves out because
// they start in contact, or too near to it. The frame at which the first remaining step starts
// becomes the first frame, because the detector is made there. Nothing if a coordinate is beyond
// what the contract can hold, or if no step is left: the case is then not for this detector. A
// query (query_case.h) is taken or left out as a whole; a case that says that it is a query and is
// none is not taken.
std::optional<corpus::Case> contracted(const corpus::Case& c, const Contract& contract);

// The case with only the steps at these places, ascending, and the frames that they use. REQUIRES
// at least one place.
corpus::Case with_steps(const corpus::Case& c, const std::vector<std::size_t>& places);

}  // namespace assay::properties
