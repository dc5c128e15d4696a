// A share of a certificate's trials made and judged once more, for `assay verify --again`.
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
  double share = 0;  // of the trials, above 0, at most 1
  std::uint64_t seed = 0;
  // No library: where it was when the trials were run.
  DetectorWords detector;
  int jobs = 1;
};

// folder: of a certificate that verifies. The stores alone can be forged by whoever forges the
// certificate with them; the trials cannot, for their cases come of campaign, seed and number.
// Refused where they cannot be made: another generator than that of the trials, another worker than
// that which held the built-in detector, no library or one of other bytes than the certified one.
Expected<properties::TrialsAgain> run_certified_again(
    const std::filesystem::path& folder, const AgainRequest& request,
    const std::function<void(const properties::TrialProgress&)>& progress);

}  // namespace assay::reports
