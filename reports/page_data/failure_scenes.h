// The failures of a run, each signature with one mesh that is run again to be shown.
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/findings.h"

namespace assay::reports {

// `failures` of assay-report/2: one entry a signature, its smallest mesh with scene and picture.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

}  // namespace assay::reports
