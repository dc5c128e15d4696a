// The failures of a run as the page shows them: one mesh of each signature is run again.
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/findings.h"

namespace assay::reports {

// `failures` of assay-report/2: for each failure of the predicate, in their order, the scene and
// the picture of its smallest mesh, and the others with its signature.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

}  // namespace assay::reports
