// Makes and judges a share of a certificate's trials once more, for `assay verify --again`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "properties/campaign/phases/again.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

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
