// Verifies a certificate: whether it is what follows from the files beside it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/certificate/statement.h"

namespace assay::reports {

struct Verification {
  std::vector<std::string> differences;  // one line each; none: the certificate is verified
  nlohmann::ordered_json statement;      // as it was read; null if it is no statement
};

// Computes counts, bounds, digests, gates and verdict again from campaign.json and the stores
// beside the certificate, and compares every field and byte. It also checks the failing meshes
// that the certificate names, junit.xml and summary.md.
Verification verify_certificate(const std::filesystem::path& certificate);
// The same, with the result of make_statement(folder) for its folder, which has been computed
// before.
Verification verify_certificate(const std::filesystem::path& certificate,
                                const properties::Expected<nlohmann::ordered_json>& computed);

// The file itself, or certificate.json in a folder.
std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder);

// A line for who was sent a certificate alone, without any of the stores that it rests on: nothing
// can be said of it. Empty if there are some, or if it is no certificate of this schema.
std::string sent_alone(const std::filesystem::path& certificate);

}  // namespace assay::reports
