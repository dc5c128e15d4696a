// The certificate: an in-toto Statement v1 about a detector, computed from the stores of a folder.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

inline constexpr const char* statement_type = "https://in-toto.io/Statement/v1";
inline constexpr const char* predicate_type = "urn:assay:certificate:7";
inline constexpr const char* certificate_schema = "assay-certificate/7";

// Findings and gates as JSON, with all text in UTF-8. `plan` has its times, which the stores do
// not state; `campaign_digest` is the SHA-256 of the campaign's file.
nlohmann::ordered_json make_predicate(const properties::RunFindings& findings,
                                      const properties::Judgement& judgement,
                                      const properties::CampaignPlan& plan,
                                      const std::string& campaign_digest);

// Makes the statement from the findings and the campaign.json in their folder alone, so that equal
// files give equal bytes. Fails if campaign.json is not there, is no plan, or is not the plan of
// the stores.
properties::Expected<nlohmann::ordered_json> make_statement(
    const properties::RunFindings& findings);
// The same, after reading the stores in `folder`; also the problems of read_findings.
properties::Expected<nlohmann::ordered_json> make_statement(const std::filesystem::path& folder);

// The statement as it is written, one field a line.
std::string statement_text(const nlohmann::ordered_json& statement);

}  // namespace assay::reports
