// What is asked of a campaign: its plan, a seed, a shard of it, and the detector to be judged.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/plan.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/trials/trial.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// A part of a campaign that is run by itself. Together its shards hold each case once.
struct Shard {
  std::uint64_t index = 1, count = 1;  // 1-based
  bool holds(std::uint64_t place) const { return place % count == index - 1; }
};

// "1/4"
std::string text_of(const Shard& shard);

struct OwnCases {
  std::vector<corpus::Case> cases;
  std::string digest;  // SHA-256 over names and bytes of their files
};

struct CampaignRequest {
  CampaignPlan plan;
  std::uint64_t seed = 1;
  int jobs = 1;
  Shard shard;
  DetectorUnderTest detector;
  std::optional<std::filesystem::path> plugin;
  IsolationMode isolation = IsolationMode::best;  // as asked for, of the plug-in's process
  Isolation isolated;                             // as it turned out
  std::uint64_t threads = 1;                      // that the plug-in may use
  bool takes_threads = false;                     // whether it asks for that number
  std::filesystem::path worker;                   // the program assay-worker
  // Where another run of this build has shown its planted faults found, its rows: then no fault is
  // planted here.
  std::optional<PowerProof> power;
  // Cases of whoever owns the detector, judged beside what is shipped.
  std::optional<OwnCases> own_cases;
  // Sequences on which a plug-in is run again and again, besides the scenes (phases/repetitions.h).
  std::vector<corpus::Case> repeated;

  // Of the workers that run its cases.
  WorkerLimits worker_limits() const {
    return {plan.case_seconds, plan.case_bytes, isolation, isolated, threads};
  }
};

// When a phase of the run must be over. Only what the user asked for by --time, or a campaign file
// by `seconds`, is such a limit: it makes the run incomplete and decides no trial.
using RunDeadline = std::chrono::steady_clock::time_point;

// So many seconds after `begin`; never, where that is more than three years: a clock of nanoseconds
// would overflow.
RunDeadline deadline_in(RunDeadline begin, double seconds);
// `share` of the plan's seconds after `begin`; never, where the plan has no limit.
RunDeadline deadline_after(RunDeadline begin, const CampaignPlan& plan, double share);

// How many of a family's cases the shard holds, and of all families.
std::uint64_t planned_cases(const StratumPlan& stratum, const Shard& shard);
std::uint64_t planned_trial_count(const CampaignPlan& plan, const Shard& shard);

// "quick:1:closed-generic:12".
std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index);

}  // namespace assay::properties
