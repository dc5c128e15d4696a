// A detector that is known to be wrong goes the whole way that the one under test goes: a run in
// which it hides is a run that sees nothing.
#pragma once

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"

namespace assay::properties {

// Random cases of all families in turn, 400 at most, until the planted fault shows. Throws
// StoreProblem (cannot_start) where there is no worker.
Canary meet_canary(const CampaignRequest& request);

}  // namespace assay::properties
