// Draws the cases of a campaign's random trials, runs and judges the trials, and counts the traits
// of their cases.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "oracle/mesh/step.h"
#include "properties/campaign/ledger/record.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/claims/claims.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/judging/verdict.h"
#include "properties/laws/law.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// The functions below find the case of a trial for a detector with a contract.

// A case of a family, and the part of this case that the contract takes.
struct TrialCase {
  RandomCase source;
  // The case as given to the detector and the oracle; nothing if the contract takes none of the
  // cases that were drawn.
  std::optional<Case> input;
  std::uint64_t redrawn = 0;         // the number of cases that were rejected before `source`
  std::uint64_t steps_left_out = 0;  // steps of this case that the contract leaves out
};

// Limits of the cases that case_within() rejects for one trial.
inline constexpr std::uint64_t most_redrawn = 200, most_without_contact = 40;
// Returns the case of a trial id, changed by brought_into_contract. A rejected case is replaced by
// the case of the next id ("quick:1:broken:3~1", then "~2", ...), at most most_redrawn times; after
// that, returns the last drawn case that the contract takes. So a stratum has the same number of
// cases under every contract. A case is rejected
//   if the contract takes none of its steps;
//   if all of its steps start within the contract's separation;
//   if it has no contact that counts. This last rule is only for every fourth case of a family, and
//   only if the family has queries or the contract leaves contacts out. It rejects at most
//   most_without_contact cases.
// Under a contract with a separation about every second case is aimed at the separation (parts.h).
// Under the default contract the result for a mesh is the case of the id, unchanged.
TrialCase case_within(const Contract& contract, const Family& family, const std::string& id);

// Scales the case by a power of two, so that the contract is more likely to take the case. Applies
// the first of these rules that makes no coordinate exceed the contract's range:
//   If the contract has a separation, the mesh becomes twice to 512 times as large as the
//   separation. In a mesh of more than 400 triangles, the median edge becomes twice to 8 times as
//   long as the separation instead.
//   If the contract has a start_distance, the mesh becomes at least eight times as large as this
//   distance, because in a smaller mesh features hardly lie that far apart.
//   If the contract has a range, the case is scaled until its largest coordinate, or its shortest
//   edge, is in the range.
Case brought_into_contract(Case c, const Contract& contract);

// The functions below find the cases that keep the promise of Start::clean.

// Returns whether the oracle calls every triangle clean (detector/LAWS.md) at every new start of
// the case. For an unclosed mesh this depends on the apexes of the ghosts. The built-in detector
// places the apexes, so it runs in a copy of this process, where it can crash without harm.
bool starts_clean(const Case& c);

// Returns whether trial `index` of a family uses Start::clean. Every second trial of the built-in
// detector does, if the case starts clean and the mesh has at most 400 triangles.
bool is_vouched_for(const DetectorUnderTest& detector, const Case& c, std::uint64_t index);

// Returns the configurations with Start::clean in place of Start::verified.
std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations);

// The functions below count the traits of a case: its extremes, its tags, the laws checked, and for
// each contact the view sets of its two triangles.

// Returns the extremes of a case; nothing is known of a detector beyond the extremes on which it
// was tried. `truth` has the oracle's judgement of each step. Costs O(vertices + triangles), and
// compares each frame with one other frame. REQUIRES triangles that a detector accepts.
Extremes extremes_of(const Case& c, std::span<const StepJudgement> truth);

// Returns the new starts: the places in steps_of(c) of the steps that do not start where the last
// committed step ended.
std::vector<std::size_t> new_starts(const Case& c);

struct CaseTally {
  TrialCounts counts;
  std::vector<FailureRecord> failures;  // of broken laws
};

// A case on which the built-in detector was examined in some configurations.
struct TallyInput {
  const CaseResults& results;
  std::span<const Configuration> configurations;
  std::span<const std::string> tags = {};
  bool with_laws = true;
};

// Returns the counts of each of the cases. If TallyInput::with_laws is set, the laws are checked in
// each configuration that has view sets, asks for all pairs and uses exact arithmetic. A copy of
// this process checks the laws of all cases (check_in_copies).
std::vector<CaseTally> tally_cases(std::span<const TallyInput> cases);

// Returns the reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

// A law runs the built-in detector again, in a copy of this process. If the detector crashes there,
// the law is broken, and all other checks go on.

// Runs check(0) to check(count - 1), in this order, in a copy of this process. If a check ends the
// copy, its law is broken: the law's tally says how the copy ended, and the next check runs in a
// new copy. So `check` must not rely on data that an earlier call has left in memory. case_of(i)
// returns the id of the case of check i, for the text of a tally. Throws the exceptions of `check`,
// and std::runtime_error if copies are killed from outside again and again. A copy costs some ten
// milliseconds, mostly for pages that both processes write, so check many cases together.
std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check);

// A law about a plug-in compares a case with another form of the case: the case after a change that
// does not change the truth (changes/changes.h).
//
// The law is broken if a claim holds in the case and fails in the form; the oracle judges the form
// like any case. A detector that claims to be deterministic also breaks the law by different
// answers to the same calls. Other different answers are only counted, because claims allow, for
// example, a wider interval of time or a false alarm in one of the two forms.

struct FormCheck {
  // `premise` and `differs` count steps, and `broken` is 0 or 1; all are 0 if nothing was judged.
  LawCount count;
  std::optional<FailureRecord> failure;  // the failure of the form, if the law is broken
  std::uint64_t disturbances = 0;
};

// Runs the form of a case in the worker and judges the run. Judges nothing if the change does not
// apply to the case, if the contract leaves some steps of the form out, or if the run exceeds its
// time or memory. `run` is the run of the case. Throws StoreProblem if there is no worker. REQUIRES
// a contracted case of a mesh in which all pairs count, a `run` that holds, and a law with a
// change.
FormCheck check_in_form(const Law& law, const Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker);

// Returns whether the detector is also tested on other forms of the case, by check_in_form().
bool has_forms(const DetectorUnderTest& detector, const Case& c);

// The trials of a campaign run in several threads. Each thread has worker processes of its own.

// Numbers of trials of the run. `stored_trials` counts the trials that an earlier call stored.
// `done_trials` includes these trials; `defects`, `undecided` and `disturbed` do not.
struct TrialProgress {
  std::uint64_t done_trials = 0, quota = 0, stored_trials = 0;
  std::uint64_t defects = 0, undecided = 0, disturbed = 0;
};
using OnTrial = std::function<void(const TrialProgress&)>;

struct TrialsEnd {
  bool complete = false;        // every planned trial of the run is in the store
  double seconds = 0;           // the time that this call took
  std::uint64_t trials = 0;     // the number of trials that this call judged
  std::string harness_problem;  // the error of the harness itself that ended the call, if any
  // Any other problem that ended the call early: a store that could not be written, a worker that
  // could not be started (the system gives no process, or the plug-in does not load any more), or
  // too little memory.
  std::optional<Problem> problem;
};

// Makes and judges the trials that are not in the store yet, from all families in turn, until all
// trials are done or the deadline has passed. Every record is stored soon after its trial is
// judged, so that a killed run loses only a few trials. The records are the same for any number of
// jobs. `progress` is called from one thread at a time. `only` has the ids of the trials to run; if
// it is null, all planned trials run.
//
// Throws StoreProblem if the store cannot be read at the beginning, so this function is only for
// campaign/.
TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const OnTrial& progress, const std::set<std::string>* only = nullptr);

// Returns the case of a failure in the form in which it is stored: with the options of the
// configuration that failed.
Case failing_case(const Case& c, const Configuration& configuration,
                  const DetectorUnderTest& detector, const Failure& failure);
// Returns the record of a failure, under the id of the case. `flaky` says that a second run of the
// case does not show the failure.
FailureRecord stored_failure(Source source, const Case& c, const Configuration& configuration,
                             const DetectorUnderTest& detector, const Failure& failure, bool flaky,
                             const std::string& output);

// Throw StoreProblem if there was no worker, so both functions are only for campaign/.
void throw_if_not_run(const CaseResults& results);
void throw_if_not_run(const CaseRun& run);

}  // namespace assay::properties
