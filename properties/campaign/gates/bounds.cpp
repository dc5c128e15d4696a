#include "properties/campaign/gates/bounds.h"

#include "properties/campaign/gates/statistics.h"
#include "properties/campaign/query_plan.h"
#include "properties/queries/query_families.h"

namespace assay::properties {

std::uint64_t number_of_bounds(const BoundRun& run) {
  const bool alone = asks_queries_alone(run.plan);
  std::uint64_t on_steps = 0, bounds = 0;
  for (const auto& configuration : run.detector.configurations)
    on_steps += configuration.claims.size();
  for (const auto& stratum : run.plan.strata) {
    const bool is_of_queries = is_query_family(stratum.family) && !alone;
    bounds += is_of_queries ? run.detector.query_claims.size() : on_steps;
  }
  return bounds;
}

double risk_of_each(const BoundRun& run) { return risk_of_each(number_of_bounds(run)); }

double bound_of(const StratumTally::Outcomes& outcomes, const BoundRun& run) {
  const auto n = outcomes.trials();
  return upper_bound(n - outcomes.holds, n, risk_of_each(run));
}

}  // namespace assay::properties
