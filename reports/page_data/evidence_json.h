// What a run found out besides its trials, and what a certificate adds, as the page shows it
// (assay-report/2, reports/README.md).
#pragma once

#include <nlohmann/json.hpp>

#include "properties/campaign/findings.h"

namespace assay::reports {

// A list; null where no faults were planted.
nlohmann::ordered_json faults_json(const properties::RunFindings& findings);
// Campaign and seed of the run that planted them; null: this one.
nlohmann::ordered_json faults_taken_from(const properties::RunFindings& findings);
nlohmann::ordered_json worlds_json(const properties::RunFindings& findings);

// `certificate`, of a whole statement.
nlohmann::ordered_json certificate_json(const nlohmann::ordered_json& statement);

}  // namespace assay::reports
