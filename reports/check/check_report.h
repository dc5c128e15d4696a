// The report of `check`, schema assay-check/1 (documented in reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "detector/mesh/topology.h"
#include "reports/check/check_outcome.h"
#include "reports/check/subject.h"

namespace assay::reports {

// `steps`: an entry for each step that was judged (steps/step_json.h).
nlohmann::ordered_json check_report(const std::vector<std::string>& files,
                                    const detector::Topology& mesh, const Subject& subject,
                                    const CheckOutcome& outcome, nlohmann::ordered_json steps);

}  // namespace assay::reports
