#include "properties/campaign/gates/bounds.h"

#include <algorithm>

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

bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration) {
  if (findings.is_left_out(stratum)) return true;
  const auto outcomes = findings.outcomes_of(stratum, configuration);
  if (stratum.wanted_bound <= 0) return outcomes.open() == 0;
  return findings.alone || bound_of(outcomes, findings.run) <= stratum.wanted_bound;
}

bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum) {
  const auto& all = findings.tally_of(stratum).by_configuration;
  return std::all_of(all.begin(), all.end(),
                     [&](const auto& outcomes) { return outcomes == all.front(); });
}

}  // namespace assay::properties
