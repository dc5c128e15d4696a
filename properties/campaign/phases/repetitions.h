// Large meshes through a plug-in again and again: the claim `deterministic`, beyond the small
// meshes of the trials, where threads have little to share out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

// The numbers of threads that a plug-in which asks for one is told in turn; the last one twice.
inline constexpr std::uint64_t repeated_threads[] = {1, 2, 4, 4};

// Whether the plan asks for them, of this detector: a plug-in of steps, or of a broad phase, that
// claims to be deterministic.
bool is_repeated(const CampaignPlan& plan, bool built_in, const std::vector<Claim>& claims);

// Puts every scene of the corpus at the plan's size, and the request's other sequences, to the
// plug-in: with each of repeated_threads where it asks how many it may use, else twice. Stores a
// Repetition for each that this shard holds and that is not stored yet. Where an answer differs
// from that of the first run, or a claimed `total` ends a run, that is a failure of the run, its
// mesh the step that differs. A run that hangs is told and breaks nothing; after three such meshes
// no further one is run. The oracle is not asked. Throws StoreProblem: for campaign/ alone.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
