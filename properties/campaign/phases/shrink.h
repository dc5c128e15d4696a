// Shrinks what a detector fails on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/judging/verdict.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// A judge that runs a case in the worker and asks the oracle; the judge returns nothing if the case
// holds. The arguments must outlive it. `jobs` are threads of the oracle for large meshes.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, int jobs = 1);

// Shrinks one case, by that judge.
Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {}, int jobs = 1);

// Shrinks the first stored failure of each signature (failures of one signature break the same
// claim in the same way). One that has been shrunk before is left alone, and so is one that the
// store calls flaky. Flaky is also what its own case does not show in a new process; then the next
// two of the signature are tried. One whose shrinking was interrupted goes on from its smallest
// mesh so far. Each better mesh is stored as soon as it is found. `limits` hold for each failure,
// the deadline for all. Throws StoreProblem, which only campaign/ catches.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// Makes the detector's own choice of a view primitive part of the case.

// The same case with the primitive of its first component stated. Nothing if the culling has no
// views, if the case states a primitive already, or if the mesh is refused.
std::optional<corpus::Case> with_explicit_view(const corpus::Case& c,
                                               const detector::Options& options);

// The finding for which the reducer keeps a failure.
Finding finding_of(const Failure& failure);

}  // namespace assay::properties
