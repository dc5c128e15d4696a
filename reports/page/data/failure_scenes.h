// The failures of a run, each signature with one mesh that is run again to be shown.
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/findings.h"

namespace assay::reports {

// `failures` of assay-report/2: for each of the predicate's failures, in their order, the scene and
// the picture of its smallest mesh, and the others of its kind.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

}  // namespace assay::reports
