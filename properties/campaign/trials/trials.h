// Runs the trials of a campaign in threads, each with a worker process of its own.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/judging/exam.h"

namespace assay::properties {

// Numbers of trials of the run. `stored` counts those that an earlier call stored; `done`
// includes them, the numbers of the second line do not.
struct TrialProgress {
  std::uint64_t done = 0, planned = 0, stored = 0;
  std::uint64_t defects = 0, undecided = 0, disturbed = 0;
};

struct TrialsEnd {
  bool complete = false;        // every planned trial of the run is in the store
  double seconds = 0;           // the time of this call
  std::uint64_t trials = 0;     // judged in this call
  std::string harness_problem;  // what kept the harness itself from going on; empty: nothing
  // The problem that ended it early, if any: a store that could not be written, a worker that
  // could not be had (the system gives no process, or the plug-in does not load any more), too
  // little memory.
  std::optional<Problem> problem;
};

// Makes and judges the trials that are not in the store yet, from the families in turn, until all
// are done or the deadline is over. Every record is stored as soon as it is known, so that a
// killed run loses only the cases that are being judged. The records do not depend on the number
// of jobs. `progress` is called from one thread at a time. `only` gives the ids of the trials that
// count as planned; without it all trials of the run do.
//
// Throws StoreProblem if the store cannot even be read at the beginning; so it is for campaign/
// alone.
TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const std::function<void(const TrialProgress&)>& progress,
                     const std::set<std::string>* only = nullptr);

// The case of a failure as it is stored: with the options of its configuration.
corpus::Case failing_case(const corpus::Case& c, const Configuration& configuration,
                          const DetectorUnderTest& detector, const Failure& failure);
// The failure as it is stored, under the id of the case. One that a second run does not show is
// flaky.
StoredFailure stored_failure(Source source, const corpus::Case& c,
                             const Configuration& configuration, const DetectorUnderTest& detector,
                             const Failure& failure, bool flaky, const std::string& printed);

// Both throw StoreProblem if there was no worker; so they are for campaign/ alone.
void throw_if_not_run(const Examined& examined);
void throw_if_not_run(const CaseRun& run);

}  // namespace assay::properties
