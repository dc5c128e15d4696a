// Runs the trials of a campaign: in threads, each with its own worker process.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

// Trials of the shard. `done` holds those that an earlier call stored, which the other counts leave
// out.
struct TrialProgress {
  std::uint64_t done = 0, planned = 0, stored = 0;
  std::uint64_t defects = 0, undecided = 0, disturbed = 0;
};

struct TrialsEnd {
  bool complete = false;        // every planned trial of the shard is in the store
  double seconds = 0;           // of this call
  std::uint64_t trials = 0;     // judged in this call
  std::string harness_problem;  // what kept the harness itself from going on; empty: nothing
  // What ended it early: a store that could not be written, a worker that could not be had (where
  // the system gives no process, or the plug-in does not load any more), too little memory.
  std::optional<Problem> problem;
};

// Makes and judges what is not in the store yet, families in turn, until all is done or the
// deadline is over. Every record is stored as soon as it is known: a killed run loses only the
// cases at work. The records do not depend on the number of jobs. `progress` is called from one
// thread at a time. Throws StoreProblem where the store cannot even be read at the beginning: for
// campaign/ alone. only: the ids of the trials that count as planned; all of the shard where it is
// not given.
TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const std::function<void(const TrialProgress&)>& progress,
                     const std::set<std::string>* only = nullptr);

// The case of a failure, ready to be stored: with the options of its configuration.
corpus::Case failing_case(const corpus::Case& c, const Configuration& configuration,
                          const DetectorUnderTest& detector, const Failure& failure);

}  // namespace assay::properties
