// Makes the page of `assay report`: first each run as JSON, an element of `runs` of assay-report/3
// (reports/schemas/report.schema.json), then one HTML file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"

namespace assay::reports {

// Returns an element of `runs` without the member `failures`. `statement` is read from the
// certificate in the run's folder; null if there is no certificate. `unverified` is the first
// reason why the certificate does not verify; if it is not empty, the run's verdict is
// "unverified", whatever its gates say.
nlohmann::ordered_json run_json(const properties::RunFindings& findings,
                                const properties::Judgement& judgement,
                                const nlohmann::ordered_json& statement = nullptr,
                                const std::string& unverified = "");

// Returns the list `failures` of assay-report/3: one element for each failure that the
// certificate's predicate lists, in that order. An element has the scene and the picture of the
// smallest mesh, and the other failures with the same signature. To make the scene, the detector
// runs the smallest mesh again.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

// Returns the page without data. It was embedded when the program was built.
std::string_view page_template();

// Returns the data as JSON that may stand inside a script element: no '<', '>' or '&', and only
// ASCII (so no U+2028). Text that is no UTF-8 is replaced.
std::string script_safe(const nlohmann::ordered_json& data);

// Returns the template `page` with the data in place of the mark. REQUIRES that `page` contains the
// mark for the data exactly once, like page_template().
std::string page_text(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace assay::reports
