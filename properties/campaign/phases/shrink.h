// Shrinks what a detector fails on.
#pragma once

#include "properties/campaign/phases/explicit_view.h"
#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// A judge that runs a case in the worker and asks the oracle; nothing if the case holds.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker);

// Shrinks one case, by that judge.
Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {});

// Shrinks one failure of each signature, unless that has been done before; flaky failures are left
// out. One whose shrinking was interrupted goes on from its smallest mesh so far. Each better mesh
// is stored as soon as it is found. At most `limits` for each, and not beyond the deadline. Throws
// StoreProblem; so it is for campaign/ alone.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
