#include "properties/campaign/query_plan.h"

#include <algorithm>

#include "properties/queries/query_families.h"

namespace assay::properties {

bool asks_queries(const CampaignPlan& plan) {
  return std::any_of(plan.strata.begin(), plan.strata.end(),
                     [](const StratumPlan& s) { return is_query_family(s.family); });
}

bool asks_queries_alone(const CampaignPlan& plan) {
  return !plan.strata.empty() &&
         std::all_of(plan.strata.begin(), plan.strata.end(),
                     [](const StratumPlan& s) { return is_query_family(s.family); });
}

CampaignPlan query_plan(CampaignPlan plan) {
  if (asks_queries_alone(plan)) return plan;
  StratumPlan largest;
  for (const auto& stratum : plan.strata) {
    if (stratum.cases > largest.cases) largest = stratum;
  }
  plan.strata.clear();
  for (const auto& family : query_families())
    plan.strata.push_back({std::string(family.name), largest.cases, largest.wanted_bound});
  plan.laws_every = 0;
  plan.law_premises = 0;
  plan.tetrahedron_seconds = 0;
  return plan;
}

}  // namespace assay::properties
