// The bounds that the trials of a campaign support, all of them together.
#pragma once

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// Strata times the claims of all configurations. A trial that breaks any claim of a configuration
// counts against its bound, so one bound holds for all its claims. They are counted all the same:
// that only widens the bounds.
std::uint64_t number_of_bounds(const BoundRun& run);

// The risk of each bound, all of them together at family_confidence.
double risk_of_each(const BoundRun& run);

// On the share of cases on which one configuration does not hold.
double bound_of(const StratumTally::Outcomes& outcomes, const BoundRun& run);

}  // namespace assay::properties
