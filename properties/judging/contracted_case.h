// A case as a detector's contract has it: what detector and oracle are both given.
#pragma once

#include <optional>

#include "corpus/cases/case_file.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// Coordinates rounded, and without the steps that the contract leaves out: those that start in
// contact, or too near to it. The frame at which the first of the others starts is the first
// frame, for a detector is made there. Nothing when a coordinate is beyond what the contract can
// hold, or no step is left: then the case is none for this detector. A query (query_case.h) is
// taken or not as a whole; what says that it is one and is none is not taken.
std::optional<corpus::Case> contracted(const corpus::Case& c, const Contract& contract);

// The same case with the steps of these places alone, ascending, and the frames that they use.
// REQUIRES at least one place.
corpus::Case with_steps(const corpus::Case& c, const std::vector<std::size_t>& places);

}  // namespace assay::properties
