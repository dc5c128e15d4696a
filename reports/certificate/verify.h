// Verifies certificates: whether each is what follows from the files beside it. Makes and judges a
// share of their trials once more.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "properties/campaign/phases/phases.h"
#include "properties/problem.h"
#include "reports/certificate/statement.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

struct Verification {
  std::vector<std::string> differences;  // one line each; none: the certificate is verified
  nlohmann::ordered_json statement;      // as it was read; null if it is no statement
  // Files beside it, and in failures/ and slow/, that were not looked at, such as a page: nothing
  // of it rests on them.
  std::vector<std::string> others = {};
};

// Computes counts, bounds, digests, gates and verdict again from campaign.json and the stores
// beside the certificate, and compares every field and byte. It also checks the failing meshes
// that the certificate names, junit.xml and summary.md. It names the other files.
Verification verify_certificate(const std::filesystem::path& certificate);

// The file itself, or certificate.json in a folder.
std::filesystem::path certificate_in(const std::filesystem::path& file_or_folder);

// A line for who was sent a certificate alone, without any of the stores that it rests on: nothing
// can be said of it. Empty if there are some, or if it is no certificate of this schema.
std::string sent_alone(const std::filesystem::path& certificate);

// What is asked of `assay verify --again`.
struct AgainRequest {
  double share = 0;  // share of the trials, above 0, at most 1
  std::uint64_t seed = 0;
  // If no library is named, it is taken from where it was when the trials were run.
  DetectorWords detector;
  int jobs = 1;
};

// REQUIRES that the certificate in `folder` verifies. Whoever forges a certificate can forge the
// stores with it. The trials cannot be forged, because their cases follow from campaign, seed and
// number.
//
// Fails if the trials cannot be made again: with another generator than theirs, with another
// worker than the one that held the built-in detector, without a library, or with one of other
// bytes than the certified one.
Expected<properties::TrialsAgain> run_certified_again(
    const std::filesystem::path& folder, const AgainRequest& request,
    const std::function<void(const properties::TrialProgress&)>& progress);

}  // namespace assay::reports
