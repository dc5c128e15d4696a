// What a run or a certificate came to as Markdown: for the summary of a CI job.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::reports {

// Verdict, gates, strata, power, failures with their replay lines. Equal predicates give equal
// bytes.
std::string summary_text(const nlohmann::ordered_json& predicate);

}  // namespace assay::reports
