// The search of a campaign (search/search.h): after the trials, in lanes that share nothing, each
// in a thread with a worker process of its own.
#pragma once

#include <filesystem>
#include <functional>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/search/search.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// Of this run; the lanes that an earlier call stored are among them.
struct SearchProgress {
  std::uint64_t lanes = 0, planned = 0, cases = 0, defects = 0;
};

// Judges cases in the worker, by the oracle and by what the detector claims. The arguments must
// outlive it. Throws StoreProblem if there is no worker.
JudgeCases judge_in(WorkerProcess& worker, const DetectorUnderTest& detector);

// Searches in the lanes of this run that are not stored yet, and stores what each comes to: its
// defects with their meshes, then the lane itself. So a run that is killed does again what was cut,
// and finds the same. What is found depends on plan, seed and share alone, not on the number of
// jobs; a lane that the deadline ends is not stored. `corpus` is the folder of the curated cases.
// `progress` is called from one thread at a time. Throws StoreProblem; so it is for campaign/
// alone.
void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const std::function<void(const SearchProgress&)>& progress);

}  // namespace assay::properties
