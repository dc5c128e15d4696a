// The bounds that the trials of a campaign support, all of them together.
#pragma once

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// The number of bounds: strata times the claims of all configurations. A trial that breaks any
// claim of a configuration counts against that configuration's bound, so one bound holds for all
// of its claims. Each claim is counted all the same, which only widens the bounds.
std::uint64_t number_of_bounds(const BoundRun& run);

// The risk of each bound, so that all of them hold together with family_confidence.
double risk_of_each(const BoundRun& run);

// The bound on the share of cases on which one configuration does not hold.
double bound_of(const StratumTally::Outcomes& outcomes, const BoundRun& run);

}  // namespace assay::properties
