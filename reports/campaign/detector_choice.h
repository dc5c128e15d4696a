// The detector that a run is about: the built-in one, or a plug-in.
#pragma once

#include <optional>
#include <string>

#include "properties/campaign/request.h"

namespace assay::reports {

// Sets request.detector and request.plugin; request.worker is set. Empty: the built-in one. One
// line for the user when the library cannot serve.
std::optional<std::string> choose_detector(const std::string& library,
                                           properties::CampaignRequest& request);

}  // namespace assay::reports
