// A run as the page shows it: `runs[]` of assay-report/2, documented in reports/README.md.
#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "reports/pictures/case_scene.h"

namespace assay::reports {

// Everything but `failures`. `statement` is that of the certificate in the run's folder; null if
// there is none. `unverified` is the first line of what keeps it from being verified; if it is not
// empty, the run's verdict is "unverified", whatever its gates say.
nlohmann::ordered_json run_json(const properties::RunFindings& findings,
                                const properties::Judgement& judgement,
                                const nlohmann::ordered_json& statement = nullptr,
                                const std::string& unverified = "");

// `failures` of assay-report/2: one mesh of each signature is run again. For each failure of the
// predicate, in their order, it is the scene and the picture of its smallest mesh, and the others
// with its signature.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

}  // namespace assay::reports
