// Stored trials made and judged once more: whether they come to what is stored of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/trials/trials.h"
#include "properties/problem.h"

namespace assay::properties {

struct TrialsAgain {
  std::uint64_t trials = 0;  // that were run once more
  std::uint64_t stored = 0;  // of so many
  // Of the first that came to something else, by family and index: "trial ID: bvh is D now, H is
  // stored".
  std::optional<std::string> difference;
};

// Draws a share (above 0, at most 1) of the trials that the stores of a folder hold, at least one,
// by the seed; makes and judges them as the request says and compares outcomes in every
// configuration, triangles, steps, collisions, pairs, counts and mesh. Times may differ, so a trial
// that ended at its limit of time may come to something else on a slower machine.
//
// request: of the plan, seed and detector of the stores, as one shard. The problems are those of
// Store::read; cannot_start where the detector cannot be run, no_run where no trial is stored.
// O(trials stored) to draw them, then what the trials took when they were run first.
Expected<TrialsAgain> run_again(const CampaignRequest& request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed,
                                const std::function<void(const TrialProgress&)>& progress);

}  // namespace assay::properties
