// A run as the page shows it: `runs[]` of assay-report/3 (reports/schemas/report.schema.json); and
// the page as one file.
#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

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

// `failures` of assay-report/3: one mesh of each signature is run again. For each failure of the
// predicate, in their order, it is the scene and the picture of its smallest mesh, and the others
// with its signature.
nlohmann::ordered_json failure_scenes(const properties::RunFindings& findings);

// The template, embedded when the program was built.
std::string_view page_template();

// The data as JSON that may stand inside a script element: no '<', '>' or '&', and only ASCII (so
// no U+2028). Text that is no UTF-8 is replaced.
std::string script_safe(const nlohmann::ordered_json& data);

// The template `page` with the data. REQUIRES that it holds the mark of the data exactly once, as
// page_template() does.
std::string page_text(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace assay::reports
