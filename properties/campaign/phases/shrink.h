// Shrinks what a detector fails on.
#pragma once

#include "properties/campaign/phases/explicit_view.h"
#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// A judge that runs a case in the worker and asks the oracle; the judge returns nothing if the case
// holds. The arguments must outlive it.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker);

// Shrinks one case, by that judge.
Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {});

// Shrinks the first stored failure of each signature (failures of one signature break the same
// claim in the same way). One that has been shrunk before is left alone, and so is one that the
// store calls flaky. One whose shrinking was interrupted goes on from its smallest mesh so far.
// Each better mesh is stored as soon as it is found. `limits` hold for each failure, the deadline
// for all. Throws StoreProblem, which only campaign/ catches.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
