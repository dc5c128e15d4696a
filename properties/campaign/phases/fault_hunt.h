// Plants every registered fault in the detector and counts the cases that the harness needs to find
// it.
#pragma once

#include <functional>
#include <optional>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/faults/fault.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

struct FaultResult {
  const Fault* fault = nullptr;  // of faults()
  FaultProof proof;
  // The first case that showed it, under the first seed that did.
  std::optional<corpus::Case> shown_by;
};

struct FaultHunt {
  std::string campaign;  // ids are campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // at most, of a seed, over all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: not tried
  Shard shard;                    // of the registered faults, by their place in the list
};

// How far a hunt is: in seed `seed` of `seeds`, `cases` of at most `most_cases` were judged, and of
// the `planted` faults `hidden` did not show yet.
struct HuntProgress {
  int seed = 0, seeds = 0;
  std::uint64_t cases = 0, most_cases = 0;
  std::size_t hidden = 0, planted = 0;
};
using OnHunt = std::function<void(const HuntProgress&)>;

// One judgement of a case serves all faults; a fault found under a seed leaves that seed's round.
// Equivalent and open ones run along to the end. The result does not depend on the number of jobs,
// unless the deadline ends it. About 0.2 ms a case and fault left.
std::vector<FaultResult> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                     const OnHunt& progress);

// What the fault shows in a case, by the claims of its options; nothing: it holds.
std::optional<Failure> failure_of_fault(const Fault& fault, const corpus::Case& c,
                                        const std::vector<oracle::StepJudgement>& truth);

// The reducer's judge for a fault, its own oracle included.
Judge judge_of_fault(const Fault& fault);

// Shrinks `shown_by` of each result that has one; how small it became is told in its proof.
// `progress` is called with the fault's name.
void shrink_faults(std::vector<FaultResult>& results, const ReduceLimits& limits, int jobs,
                   RunDeadline deadline, const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
