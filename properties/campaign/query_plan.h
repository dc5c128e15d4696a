// Puts elementary queries into a campaign of meshes, beside its families or in their place.
#pragma once

#include "properties/campaign/plan.h"

namespace assay::properties {

// Whether some stratum is one of queries (queries/query_families.h).
bool asks_queries(const CampaignPlan& plan);
// Whether all strata are.
bool asks_queries_alone(const CampaignPlan& plan);

// The same campaign with every family of queries beside its strata. Each has as many cases as the
// largest stratum, and the bound that is wanted there. A plan that asks queries, or plans no case,
// stays as it is.
CampaignPlan with_queries(CampaignPlan plan);
// The same campaign without its strata of queries.
CampaignPlan without_queries(CampaignPlan plan);

// The same campaign with every family of queries in place of its strata. There are no laws and no
// worlds, because these are about meshes. A plan that asks queries alone stays as it is.
CampaignPlan query_plan(CampaignPlan plan);

}  // namespace assay::properties
