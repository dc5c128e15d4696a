// Keeps the cases on which a detector takes longest with their meshes, and shrinks them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

// How many of the trials that reached the limit of a case, or came near it, are kept with a mesh.
// The slowest come first.
inline constexpr std::size_t slow_cases_kept = 5;

// Stores a SlowCase for each of these trials that is not stored yet. Then shrinks those that take
// twice the limit of a case or more: a smaller case is accepted if the median of three runs is at
// least twice the limit. No case is shrunk beyond `limits`, nor beyond the deadline.
//
// Processor time alone decides. Still, two runs of one campaign may shrink differently, so what is
// stored here `may_differ`. Throws StoreProblem; so it is for campaign/ alone.
void keep_slow_cases(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// A judge that finds a case that takes at least `seconds` of processor time, by the median of
// three runs; a case that sleeps does not count. REQUIRES a worker whose limit is `seconds`.
Judge judge_of_slowness(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, double seconds);

}  // namespace assay::properties
