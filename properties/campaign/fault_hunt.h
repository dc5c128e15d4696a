// Plants every registered fault in the detector and counts the cases that the harness needs to find
// it.
#pragma once

#include <optional>
#include <span>

#include "properties/campaign/runner.h"
#include "properties/faults/fault.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

struct FaultResult {
  const Fault* fault = nullptr;
  bool by_curated = false;  // its curated case shows it
  // For each seed: the number of cases until it showed; nothing within the limit.
  std::vector<std::optional<std::uint64_t>> needed;
  // The first case that showed it, under the first seed that did.
  std::optional<corpus::Case> shown_by;
  std::optional<Reduction> reduction;  // of `shown_by`, when asked for

  bool found() const;
  // Median over seeds, those without counted as above all; nothing when that is one of them.
  std::optional<std::uint64_t> median() const;
};

struct FaultHunt {
  std::string campaign;  // ids are campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // at most, of a seed, over all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: not tried
};

// One judgement of a case serves all faults; a fault found under a seed leaves that seed's round.
// Equivalent and open ones run along to the end. The result does not depend on the number of jobs,
// unless the deadline ends it. About 0.2 ms a case and fault left.
std::vector<FaultResult> hunt_faults(const FaultHunt& hunt, std::span<const Fault> faults,
                                     RunDeadline deadline,
                                     const std::function<void(const std::string&)>& progress);

// What the fault shows in a case, by the claims of its options; nothing: it holds.
std::optional<Failure> failure_of_fault(const Fault& fault, const corpus::Case& c,
                                        const std::vector<oracle::StepJudgement>& truth);

// The reducer's judge for a fault, its own oracle included.
Judge judge_of_fault(const Fault& fault);

// Shrinks `shown_by` of each result that has one; results are updated in place.
void shrink_faults(std::vector<FaultResult>& results, const ReduceLimits& limits, int jobs,
                   RunDeadline deadline, const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
