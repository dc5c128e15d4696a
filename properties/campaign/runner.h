// Runs the trials of a campaign: in threads, each with its own worker process.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>

#include "properties/campaign/plan.h"
#include "properties/campaign/store.h"
#include "properties/campaign/trial.h"

namespace assay::properties {

struct Shard {
  std::uint64_t index = 1, count = 1;  // 1-based
  bool holds(std::uint64_t place) const { return place % count == index - 1; }
};

struct CampaignRequest {
  CampaignPlan plan;
  std::uint64_t seed = 1;
  int jobs = 1;
  Shard shard;
  DetectorUnderTest detector;
  std::optional<std::filesystem::path> plugin;
  std::filesystem::path worker;  // the program assay-worker
};

// When the run as a whole must be over.
using RunDeadline = std::chrono::steady_clock::time_point;

struct TrialProgress {
  std::uint64_t done = 0, planned = 0, defects = 0;
};

struct TrialsEnd {
  bool complete = false;        // every planned trial of the shard is in the store
  double seconds = 0;           // of this call
  std::uint64_t trials = 0;     // judged in this call
  std::string harness_problem;  // what kept the harness itself from going on; empty: nothing
  std::string store_problem;    // why the store could not be written; empty: it could
};

// Makes and judges what is not in the store yet, families in turn, until all is done or the
// deadline is over. Every record is stored as soon as it is known: a killed run loses only the
// cases at work. The records do not depend on the number of jobs. `progress` is called from one
// thread at a time.
TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const std::function<void(const TrialProgress&)>& progress);

// How many trials the shard holds.
std::uint64_t planned_trial_count(const CampaignPlan& plan, const Shard& shard);

// "quick:1:closed-generic:12".
std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index);

// The case of a failure, ready to be stored: with the options of its configuration.
corpus::Case failing_case(const corpus::Case& c, const Configuration& configuration,
                          const DetectorUnderTest& detector, const Failure& failure);

}  // namespace assay::properties
