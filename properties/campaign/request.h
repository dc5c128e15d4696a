// A request for a campaign: the plan, the seed, the share of the plan that the run does, and the
// detector to be judged.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/plan.h"
#include "properties/judging/verdict.h"

namespace assay::properties {

// Returns n divided by the number of equal shares, rounded up, so that all shares together reach n.
constexpr std::uint64_t share_of(std::uint64_t n, std::uint64_t shares) {
  return (n + shares - 1) / shares;
}

struct OwnCases {
  std::vector<Case> cases;
  std::string digest;  // SHA-256 over names and bytes of the case files
};

// The seed of a campaign if the user gives no seed. Everybody knows the cases of this seed.
inline constexpr std::uint64_t default_seed = 1;

struct CampaignRequest : Subject {
  CampaignPlan plan;
  std::uint64_t seed = default_seed;
  int jobs = 1;
  // The number of equal shares into which the cases of each stratum, of each planted fault and of
  // the search are divided. The run does one share. Runs under other seeds do the other shares.
  std::uint64_t shares = 1;
  // The proof, by another run of this build, that planted faults are found. If it is there, this
  // run plants no fault.
  std::optional<PowerProof> power;
  // Cases of the detector's owner, which are judged beside the shipped cases.
  std::optional<OwnCases> own_cases;
  // Sequences that a plug-in runs several times, besides the scenes (phases/phases.h).
  std::vector<Case> repeated;

  // Returns the word of the isolation that the user asked for; empty if the user asked for none.
  const char* isolation_word() const { return limits.isolation ? name_of(*limits.isolation) : ""; }

  // Returns the limits of the workers that run the campaign's cases.
  WorkerLimits worker_limits(std::uint32_t variation = 0) const {
    auto of_case = limits;
    of_case.seconds = plan.case_seconds;
    of_case.bytes = plan.case_bytes;
    of_case.variation = variation;
    return of_case;
  }

  // Returns the limits of the worker that runs a case a second time, to judge the claim
  // `deterministic`. That worker has other hash seeds and addresses, and evaluates each step twice.
  // If the plug-in has a function that limits its threads, this worker's limit of threads differs
  // from the first worker's limit.
  WorkerLimits second_worker_limits() const {
    constexpr std::uint64_t some = 3;  // large meshes are run with 1, 2 and 4 threads (phases.h)
    auto second = worker_limits(1);
    if (description.parts.takes_threads) second.threads = limits.threads == some ? 1 : some;
    second.asks_twice = true;
    return second;
  }
};

// The time by which a phase of the run must be over. Only the user sets such a limit, by --time or
// by `seconds` of a campaign file. A deadline can make the run incomplete, but it never decides a
// trial.
using RunDeadline = std::chrono::steady_clock::time_point;

// Returns the time `seconds` after `begin`. Returns RunDeadline::max() if `seconds` is more than
// three years, because a clock of nanoseconds would overflow.
inline RunDeadline deadline_in(RunDeadline begin, double seconds) {
  constexpr double longest = 1e8;
  if (seconds > longest) return RunDeadline::max();
  return begin +
         std::chrono::duration_cast<RunDeadline::duration>(std::chrono::duration<double>(seconds));
}
// Returns the time share * plan.seconds after `begin`; RunDeadline::max() if the plan has no limit.
inline RunDeadline deadline_after(RunDeadline begin, const CampaignPlan& plan, double share) {
  return plan.seconds == 0 ? RunDeadline::max() : deadline_in(begin, share * plan.seconds);
}

// Returns the number of cases of all strata in one share.
inline std::uint64_t planned_trial_count(const CampaignPlan& plan, std::uint64_t shares) {
  std::uint64_t count = 0;
  for (const auto& stratum : plan.strata) count += share_of(stratum.cases, shares);
  return count;
}

// Returns the index of the case that a run judges at a place of a stratum; places and indices begin
// at 0. Consecutive seeds give different indices, because some families choose their shapes by the
// index.
constexpr std::uint64_t trial_index(std::uint64_t place, std::uint64_t seed, std::uint64_t shares) {
  return place * shares + seed % shares;
}

// A search of this many cases is divided into lanes (search/search.h); the last lane has the
// remaining cases. A lane has enough cases to fill an archive, and there are few enough lanes to
// list them one by one.
constexpr std::uint64_t size_of_lane(std::uint64_t cases) {
  constexpr std::uint64_t least = 500, most_lanes = 256;
  return std::max(least, share_of(cases, most_lanes));
}
constexpr std::uint64_t search_lanes(std::uint64_t cases) {
  return share_of(cases, size_of_lane(cases));
}
constexpr std::uint64_t cases_of_lane(std::uint64_t cases, std::uint64_t lane) {
  const auto size = size_of_lane(cases);
  return std::min(size, cases - lane * size);
}

}  // namespace assay::properties
