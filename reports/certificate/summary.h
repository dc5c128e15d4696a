// What a run or a certificate came to as Markdown: for the summary of a CI job.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::reports {

// Verdict, gates, strata, power, failures with their replay lines. Equal predicates give equal
// bytes.
std::string summary_text(const nlohmann::ordered_json& predicate);

// Of one of `failures`: "met 3 times", or that no trial showed it.
std::string met_text(const nlohmann::ordered_json& failure);

}  // namespace assay::reports
