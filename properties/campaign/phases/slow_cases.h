// The cases on which a detector takes longest: kept with their meshes, and shrunk.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

// How many of the trials that reached the limit, or came near it, are kept with a mesh; the
// slowest first.
inline constexpr std::size_t slow_cases_kept = 5;

// Stores a SlowCase for each of them that is not stored yet, then shrinks those that reach the
// limit of a case twice over: a smaller case is taken where the median of three runs takes at
// least twice the limit. Nothing is shrunk beyond `limits` each, nor beyond the deadline.
// Processor time alone decides, and yet two runs of one campaign may shrink differently: what is
// stored here `may_differ`. Throws StoreProblem: for campaign/ alone.
void keep_slow_cases(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// Finds a case that takes at least `seconds` of processor time, by the median of three; one that
// sleeps is none. REQUIRES a worker whose limit is that.
Judge judge_of_slowness(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, double seconds);

}  // namespace assay::properties
