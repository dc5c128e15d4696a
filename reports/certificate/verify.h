// Whether a certificate is what the files beside it come to.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/certificate/statement.h"

namespace assay::reports {

struct Verification {
  std::vector<std::string> differences;  // one line each; none: it is
  nlohmann::ordered_json statement;      // as it was read; null when it is none
};

// Counts, bounds, digests, gates and verdict are computed again from campaign.json and the stores
// beside the certificate, and every field and byte is compared; so are the failing meshes that it
// names, junit.xml and summary.md.
Verification verify_certificate(const std::filesystem::path& certificate);
// The same, where make_statement(folder) of its folder has been called before.
Verification verify_certificate(const std::filesystem::path& certificate,
                                const properties::Expected<nlohmann::ordered_json>& computed);

}  // namespace assay::reports
