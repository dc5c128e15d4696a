#include "properties/campaign/query_plan.h"

#include <algorithm>

#include "properties/queries/query_families.h"

namespace assay::properties {
namespace {

bool is_of_queries(const StratumPlan& stratum) { return is_query_family(stratum.family); }

}  // namespace

bool asks_queries(const CampaignPlan& plan) {
  return std::any_of(plan.strata.begin(), plan.strata.end(), is_of_queries);
}

bool asks_queries_alone(const CampaignPlan& plan) {
  return !plan.strata.empty() && std::all_of(plan.strata.begin(), plan.strata.end(), is_of_queries);
}

CampaignPlan without_queries(CampaignPlan plan) {
  std::erase_if(plan.strata, is_of_queries);
  return plan;
}

CampaignPlan with_queries(CampaignPlan plan) {
  if (asks_queries(plan)) return plan;
  StratumPlan largest;
  for (const auto& stratum : plan.strata) {
    if (stratum.cases > largest.cases) largest = stratum;
  }
  if (largest.cases == 0) return plan;
  for (const auto& family : query_families())
    plan.strata.push_back({std::string(family.name), largest.cases, largest.wanted_bound});
  return plan;
}

CampaignPlan query_plan(CampaignPlan plan) {
  if (asks_queries_alone(plan)) return plan;
  plan = with_queries(without_queries(std::move(plan)));
  std::erase_if(plan.strata, [](const StratumPlan& stratum) { return !is_of_queries(stratum); });
  plan.laws_every = 0;
  plan.law_premises = 0;
  plan.tetrahedron_seconds = 0;
  return plan;
}

}  // namespace assay::properties
