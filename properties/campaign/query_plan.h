// Turns a campaign of meshes into one of elementary queries, which is put to a detector's query.
#pragma once

#include "properties/campaign/plan.h"

namespace assay::properties {

// Whether some stratum is one of queries (queries/query_families.h).
bool asks_queries(const CampaignPlan& plan);
// Whether all strata are.
bool asks_queries_alone(const CampaignPlan& plan);

// The same campaign with every family of queries in place of its strata. Each has as many cases as
// the largest stratum, and the bound that is wanted there. There are no laws and no worlds,
// because these are about meshes. A plan that asks queries alone stays as it is.
CampaignPlan query_plan(CampaignPlan plan);

}  // namespace assay::properties
