// Runs large meshes through a plug-in again and again. This tries the claim `deterministic` beyond
// the small meshes of the trials, in which threads have little to share out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

// The numbers of threads, in turn, for a plug-in that asks how many it may use. The last is told
// twice.
inline constexpr std::uint64_t repeated_threads[] = {1, 2, 4, 4};

// Whether the plan asks for repetitions of this detector. It must be a plug-in of steps, or of a
// broad phase, that claims to be deterministic.
bool is_repeated(const CampaignPlan& plan, bool built_in, const std::vector<Claim>& claims);

// Puts every scene of the corpus, at the plan's size, and the request's other sequences to the
// plug-in: with each of repeated_threads if it asks how many it may use, else twice. Stores a
// Repetition for each mesh that this shard holds and that is not stored yet. If an answer differs
// from that of the first run, or a run ends in a way that breaks a claimed `total`, that is a
// failure of the run, whose mesh is the step that differs. A run that hangs is reported and breaks
// nothing; after three such meshes no further one is run. The oracle is not asked.
//
// Throws StoreProblem; so it is for campaign/ alone.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
