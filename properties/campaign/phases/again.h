// Makes and judges stored trials once more, and compares the results with what is stored.
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
  std::uint64_t trials = 0;  // trials that were run once more
  std::uint64_t stored = 0;  // trials that are stored
  // The first trial, by family and index, that came to something else: "trial ID: bvh is D now, H
  // is stored".
  std::optional<std::string> difference;
};

// Draws a share (above 0, at most 1) of the trials that the stores of a folder hold, at least one,
// by the seed. Makes and judges them as the request says, and compares the outcomes in every
// configuration, triangles, steps, collisions, pairs, counts and mesh. Times may differ, so a
// trial that ended at its limit of time may come to something else on a slower machine.
//
// REQUIRES a request with the plan and the detector of the stores; each states its own seed and
// share. Fails if a store cannot be read, if the detector cannot be run, and if no trial is stored.
// O(trials stored) to draw them, then the time that the trials took when they were first run.
Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed,
                                const std::function<void(const TrialProgress&)>& progress);

}  // namespace assay::properties
