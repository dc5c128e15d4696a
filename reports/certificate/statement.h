// The certificate: an in-toto Statement v1 about a detector, computed from the stores of a folder;
// how it is issued, of one run or of several that are judged together; and how its paths are told.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "reports/terminal/work.h"

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

// Lines are for the run's own folder, as it was when the run was stored. A path is told as it goes
// from there, or by its last name where it goes through the root.
class ToldPaths {
 public:
  explicit ToldPaths(const properties::RunFindings& findings);
  std::string told(const std::string& path) const;
  // Tells all paths so in each text of `json`.
  void tell_in(nlohmann::ordered_json& json) const;

 private:
  void tell_in(std::string& text) const;
  std::string folder_;                            // ends with a slash; empty: the root
  std::set<std::string, std::greater<>> others_;  // a folder after what lies in it
};

// Writes certificate.json, junit.xml and summary.md into the folder of the findings, and prints
// what they come to; `took` stands behind the verdict. Returns the exit code of the verdict. Fails
// if campaign.json is not this text any more, and if a file cannot be written.
Expected<int> issue_certificate(const properties::RunFindings& findings,
                                const std::string& campaign_text, const std::string& took);

// Copies the stores of these folders into `out`, and issues the certificate of all of them: shares
// of one campaign, or whole campaigns. Fails, with no store left in `out`, if they are not of the
// same plan, build and detector, and if two have the same seed.
Expected<int> judge_together(const std::vector<std::string>& folders, const std::string& out);

}  // namespace assay::reports
