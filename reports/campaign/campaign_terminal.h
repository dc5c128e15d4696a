// A campaign on the terminal: what is shown while it runs.
#pragma once

#include <string>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Does the part of the campaign that the store does not hold yet. Says what it is going to do, how
// far it is and how long that will take, and shows the failures, with their files and pictures
// below `out`, as soon as all of them are shrunk. Fails if a file or the store could not be
// written; what is stored then stays.
Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out);

}  // namespace assay::reports
