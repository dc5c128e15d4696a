// Shrinks what a detector fails on.
#pragma once

#include "properties/campaign/phases/explicit_view.h"
#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// Runs a case in the worker, judges it by the oracle; nothing when it holds.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker);

// One case, by that judge.
Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {});

// One failure of each signature that has none shrunk yet; each better mesh is stored as it is
// found. At most `limits` each, and not beyond the deadline. Throws StoreProblem: for campaign/
// alone.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
