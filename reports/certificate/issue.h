// Issues a certificate: of one run, or of several that are judged together.
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

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
