// The certificate: an in-toto Statement v1 about a detector, computed from the stores of a folder.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

inline constexpr const char* statement_type = "https://in-toto.io/Statement/v1";
inline constexpr const char* predicate_type = "urn:assay:certificate:3";
inline constexpr const char* certificate_schema = "assay-certificate/3";

// Findings and gates as JSON, all of its text UTF-8. plan: with its times, which the stores do not
// state; campaign_digest: SHA-256 of the campaign's file.
nlohmann::ordered_json make_predicate(const properties::RunFindings& findings,
                                      const properties::Judgement& judgement,
                                      const properties::CampaignPlan& plan,
                                      const std::string& campaign_digest);

// From findings and the campaign.json in their folder alone: equal files give equal bytes.
// cannot_read where campaign.json is not there, wrong_plan where it is no plan, another_run where
// it is not that of the stores.
properties::Expected<nlohmann::ordered_json> make_statement(
    const properties::RunFindings& findings);
// The same of what the stores in `folder` say; besides, the problems of read_findings.
properties::Expected<nlohmann::ordered_json> make_statement(const std::filesystem::path& folder);

// As it is written: one field a line.
std::string statement_text(const nlohmann::ordered_json& statement);

}  // namespace assay::reports
