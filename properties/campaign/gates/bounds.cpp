#include "properties/campaign/gates/bounds.h"

#include "properties/campaign/gates/statistics.h"

namespace assay::properties {

std::uint64_t number_of_bounds(const BoundRun& run) {
  std::uint64_t claims = 0;
  for (const auto& configuration : run.detector.configurations)
    claims += configuration.claims.size();
  return run.plan.strata.size() * claims;
}

double risk_of_each(const BoundRun& run) { return risk_of_each(number_of_bounds(run)); }

double bound_of(const StratumTally::Outcomes& outcomes, const BoundRun& run) {
  const auto n = outcomes.trials();
  return upper_bound(n - outcomes.holds, n, risk_of_each(run));
}

}  // namespace assay::properties
