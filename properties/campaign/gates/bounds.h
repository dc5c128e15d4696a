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

// Whether the gate bounds has nothing to say against a configuration in a stratum: its bound is not
// above the one that is wanted, or, if none is wanted, every trial has a verdict. Nothing is asked of
// a family of which the contract takes no case; no bound is asked of one shard by itself.
bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration);

// Whether all configurations came to the same outcomes in a stratum, so that one row tells them.
bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum);

}  // namespace assay::properties
