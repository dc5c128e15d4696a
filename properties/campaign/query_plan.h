// A campaign of elementary queries: the strata of a campaign of meshes, put to a detector's query.
#pragma once

#include "properties/campaign/plan.h"

namespace assay::properties {

// Whether a stratum is one of queries (queries/query_families.h).
bool asks_queries(const CampaignPlan& plan);
// Whether all are.
bool asks_queries_alone(const CampaignPlan& plan);

// The same campaign with every family of queries in place of its strata, each with as many cases as
// the largest of them and the bound that is wanted there: no laws and no worlds, for these are of
// meshes. One that asks queries alone stays as it is.
CampaignPlan query_plan(CampaignPlan plan);

}  // namespace assay::properties
