// The detector that a run is about: the built-in one, or a plug-in.
#pragma once

#include <string>

#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// The parts of a plug-in that a plan is about: steps, queries, or both.
DetectorPart part_asked_by(const properties::CampaignPlan& plan);

// Sets request.detector and, for a plug-in, the members of the request that tell of it. REQUIRES
// that request.worker is set. Fails if the library cannot serve, does not hold the part that is
// asked for, or cannot be isolated although that is required.
Expected<void> choose_detector(const DetectorWords& words, properties::CampaignRequest& request);

}  // namespace assay::reports
