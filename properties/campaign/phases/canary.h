// A detector that is known to be wrong goes through all that the detector under test goes through.
// A run in which it is not found is a run that sees nothing.
#pragma once

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"

namespace assay::properties {

// Runs random cases of all families in turn, 400 at most, until the planted fault shows. Throws
// StoreProblem if there is no worker.
Canary meet_canary(const CampaignRequest& request);

}  // namespace assay::properties
