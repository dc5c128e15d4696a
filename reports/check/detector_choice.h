// The detector that a run is about: the built-in one, or a plug-in.
#pragma once

#include <string>

#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Sets request.detector and request.plugin; request.worker is set. Empty: the built-in one. Refused
// when the library cannot serve.
Expected<void> choose_detector(const std::string& library, properties::CampaignRequest& request);

}  // namespace assay::reports
