// Runs a campaign from its canary to its worlds. Each phase leaves what it finds out in the store,
// and an observer is told of it. What the campaign comes to is read back from the store
// (findings.h) and judged (gates.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/phases/fault_hunt.h"
#include "properties/campaign/request.h"
#include "properties/campaign/trials/trials.h"
#include "properties/problem.h"
#include "properties/search/search.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// The search of a campaign (search/search.h): after the trials, in lanes that share nothing, each
// in a thread with a worker process of its own (search.cpp).

// Examines the cases of a lane. The exam must outlive it. Throws StoreProblem if there is no
// worker.
ExamineCases examine_in_lane(const Exam& exam);

// Searches in the lanes of this run that are not stored yet, and stores what each comes to: its
// defects with their meshes, then the lane itself. So a run that is killed does again what was cut,
// and finds the same. What is found depends on plan, seed and share alone, not on the number of
// jobs; a lane that the deadline ends is not stored. `corpus` is the folder of the curated cases.
// `progress` is called from one thread at a time. Throws StoreProblem; so it is for campaign/
// alone.
void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// Is told what a campaign does, in the order of its phases. Each function may be called from
// another thread than the caller's, but by one thread at a time.
class CampaignObserver {
 public:
  virtual ~CampaignObserver() = default;
  // Called first: so many trials are in the store already.
  virtual void on_begin(std::uint64_t /*trials*/) {}
  // A phase begins now: "trials", "repetitions", "search", "shrinking", "slow cases", "faults"
  // or "tetrahedron". The first of these is told after the canary.
  virtual void on_phase(const char* /*phase*/) {}
  virtual void on_canary(const Canary&) {}
  virtual void on_trial(const TrialProgress&) {}
  virtual void on_trials(const TrialsEnd&) {}
  // What the phase is at; and, if it can be counted, how much of it is done, and how much is left.
  virtual void on_progress(const std::string&, std::uint64_t /*done*/, std::uint64_t /*left*/) {}
  // All trials and their failures are stored now; faults and worlds are still to come.
  virtual void on_failures_shrunk(const KeptFailures&) {}
  // The cases on which the detector takes longest, as they were kept.
  virtual void on_slow_cases(const std::vector<SlowCase>&) {}
};

// Does what the store does not hold yet: the trials, the shrinking of what failed, and the planted
// faults (or it takes the request's proof of them). Trials have nine tenths of the plan's time; if
// some are missing then, failures are shrunk in the last tenth and nothing else is begun. The
// canary and the worlds of tetrahedra are done again; of two results for a world the one that came
// farther stays. Of a share, worlds and large meshes are done as of a whole campaign, because they
// take little time. `corpus` is the folder of the curated cases.
//
// What is stored stays, whatever happens. Fails if the store cannot be read or written any more.
Expected<void> run_campaign(const CampaignRequest& request, const std::filesystem::path& corpus,
                            Store& store, CampaignObserver& observer);

// The seconds of the clock that the shrinking of failures may take: the plan's share of its own
// limit, or two minutes if it has no limit.
double shrinking_seconds(const CampaignPlan& plan);

// Keeps what curated cases and scenes show wrong: each with a small mesh that shows it, as for the
// trials that fail.

// Takes the failures whose signature nothing in the store has, and stores the smallest mesh of each
// such signature. Then it shrinks these meshes. That takes at most a minute for each, and for all
// together the share of the plan's time that is kept for shrinking. REQUIRES failures in the order
// of the corpus. What an earlier call stored stays. `progress` is called with the signature that is
// being shrunk.
// Returns the stored failures of the corpus.
Expected<KeptFailures> shrink_corpus_failures(
    const CampaignRequest& request, const std::vector<StoredFailure>& failures, Store& store,
    const std::function<void(const std::string&)>& progress);

// Stores the rows of the corpus, and removes the failures of an earlier call that it does not show
// any more. In a run the smallest mesh of each signature is stored now, and shrunk with the
// failures of the trials; in a certificate shrink_corpus_failures does that later.
enum class KeepMeshes : std::uint8_t { now, later };
Expected<void> keep_corpus(Store& store, const std::vector<JudgedSource>& rows,
                           const std::vector<StoredFailure>& failures, KeepMeshes when);

// Makes and judges stored trials once more, and compares the results with what is stored.

struct TrialsAgain {
  std::uint64_t trials = 0;  // trials that were run once more
  std::uint64_t stored = 0;  // trials that are stored
  // The first trial, by family and index, that came to something else: "trial ID: bvh is D now, H
  // is stored".
  std::optional<std::string> difference;
};

// Draws a share (above 0, at most 1) of the trials that the stores of a folder hold, at least one,
// by the seed. Makes and judges them as the request says, and compares the outcomes in every
// configuration, triangles, steps, collisions, pairs, counts and mesh. Times may differ, so a
// trial that ended at its limit of time may come to something else on a slower machine.
//
// REQUIRES a request with the plan and the detector of the stores; each states its own seed and
// share. Fails if a store cannot be read, if the detector cannot be run, and if no trial is stored.
// O(trials stored) to draw them, then the time that the trials took when they were first run.
Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed,
                                const std::function<void(const TrialProgress&)>& progress);

}  // namespace assay::properties
