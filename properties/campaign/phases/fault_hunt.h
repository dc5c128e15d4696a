// Plants every registered fault in the detector and counts the cases that the harness needs to
// find it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/request.h"
#include "properties/faults/fault.h"
#include "properties/problem.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

struct FaultResult {
  const Fault* fault = nullptr;  // one of faults()
  FaultProof proof;
  // The first case that showed the fault, under the first seed under which one did.
  std::optional<corpus::Case> shown_by;
};

struct FaultHunt {
  std::string campaign;  // ids are campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // for each seed at most, from all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: not tried
};

// How far a hunt is, in words, and how many cases are done and left.
using OnHunt = std::function<void(const std::string&, std::uint64_t done, std::uint64_t left)>;

// Hunts for all registered faults. One judgement of a case by the oracle serves all faults. A
// fault that is found under a seed leaves the round of that seed; equivalent and open faults stay
// to its end. The result does not depend on the number of jobs, unless the deadline ends it. About
// 0.2 ms for each case and each fault that is left.
std::vector<FaultResult> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                     const OnHunt& progress);

// What the fault shows in a case, judged by the claims of its options; nothing if the case holds.
std::optional<Failure> failure_of_fault(const Fault& fault, const corpus::Case& c,
                                        const std::vector<oracle::StepJudgement>& truth);

// The reducer's judge for a fault. It asks the oracle by itself.
Judge judge_of_fault(const Fault& fault);

// Shrinks `shown_by` of each result that has one, and notes in its proof how small it became.
// `progress` is called with the name of the fault.
void shrink_faults(std::vector<FaultResult>& results, const ReduceLimits& limits, int jobs,
                   RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// A detector that is known to be wrong goes through all that the detector under test goes through.
// A run in which it is not found is a run that sees nothing.

// Runs random cases of all families in turn, 400 at most, until the planted fault shows. Throws
// StoreProblem if there is no worker.
Canary meet_canary(const CampaignRequest& request);

// Takes the proof that planted faults are found from another run of the same build. Planted faults
// prove the harness of a build, not the detector that it judges, so the run of a plug-in need not
// plant them again.

// The proof in `folder` for the request. Fails if its plan plants no faults, if the folder is `out`
// or lies below it, if the digests of program, worker or generator differ, if that run did not find
// every planted fault itself, or gave a fault fewer cases or seeds than the plan asks for, and
// where read_findings fails.
//
// REQUIRES that no code of a plug-in has run in this process's workers yet, so that whatever it
// could write to has been read before.
Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request);

}  // namespace assay::properties
