// Draws the random trials of a campaign, counts their traits, and runs them.
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

// Finds the case of a trial for a detector with a contract.

// A case of a family, and the part of it that the contract takes.
struct TrialCase {
  RandomCase source;
  // The case as given to the detector and the oracle; nothing if no attempt led to a case that the
  // contract takes.
  std::optional<Case> input;
  std::uint64_t redrawn = 0;         // how many cases before this one were rejected
  std::uint64_t steps_left_out = 0;  // steps of this case that the contract leaves out
};

// Returns the case of a trial id, brought into the contract (below). A rejected case is replaced by
// the case of the next id ("quick:1:broken:3~1", then "~2", ...), at most most_redrawn times; after
// that, the last case that the contract takes is returned. A case is rejected
//   if the contract takes none of its steps; so a stratum has as many cases under every contract;
//   if all of its steps start within the contract's separation;
//   if it has no contact that counts. This is asked of every fourth case, for queries and under a
//   contract that leaves contacts out, and rejects at most most_without_contact cases.
// Every second case under a contract with a separation is aimed at the separation (parts.h). For a
// mesh without a contract the result is the case of the id.
inline constexpr std::uint64_t most_redrawn = 200, most_without_contact = 40;
TrialCase case_within(const Contract& contract, const Family& family, const std::string& id);

// Scales the case by a power of two, so that the contract may take it. Features can hardly lie
// start_distance apart in a mesh smaller than eight times that distance, so the mesh becomes that
// large, if a range of the contract allows it. With a separation the mesh becomes twice to 512
// times as large as the separation; in a mesh of more than 400 triangles the median edge becomes
// twice to 8 times as large instead. If the contract has a range, the case is scaled until its
// largest coordinate fits, or until its shortest edge does.
Case brought_into_contract(Case c, const Contract& contract);

// Finds the cases for which Start::clean may be used, because they keep the caller's promise.

// Returns whether the oracle calls every triangle clean (L9, detector/LAWS.md) in every step of the
// case that is a new start. For an unclosed mesh that depends on the apexes of the built-in
// detector, so the detector is asked for them, in a copy of this process, which may crash.
bool starts_clean(const Case& c);

// Returns whether trial `index` of a family uses Start::clean: every second trial of the built-in
// detector does, if the case starts clean and the mesh is small.
bool is_vouched_for(const DetectorUnderTest& detector, const Case& c, std::uint64_t index);

// Returns the configurations with Start::clean in place of Start::verified.
std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations);

// Counts the traits of a case, besides its outcome, for the built-in detector and for a plug-in:
// extremes, tags, set pairs of contacts, and laws.

// Measures the extremes of the cases on which a detector is tried. Nothing is known beyond them.

// Returns the extremes of a case for which `truth` has the oracle's judgement of each step. Costs
// O(N + M), and compares each frame with one other. REQUIRES triangles that a detector accepts.
Extremes extremes_of(const Case& c, std::span<const StepJudgement> truth);

// Returns the places in steps_of(c) of the steps that do not follow a committed step.
std::vector<std::size_t> new_starts(const Case& c);

struct CaseTally {
  TrialCounts counts;
  std::vector<FailureRecord> failures;  // laws
};

// A case on which the built-in detector was examined, in these configurations.
struct TallyInput {
  const CaseResults& results;
  std::span<const Configuration> configurations;
  std::span<const std::string> tags = {};
  bool with_laws = true;
};

// Counts each of the cases. If `with_laws` is set, the laws are checked in each configuration that
// has view sets and asks for all pairs. One copy of this process checks them for all cases
// (check_in_copies).
std::vector<CaseTally> tally_cases(std::span<const TallyInput> cases);

// Returns the reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

// Checks laws where a crash of the detector does no harm. A law runs the built-in detector again,
// in this program; if that crashes, the law is broken, and all other checks go on.

// Runs check(0) to check(count - 1), in this order, in a copy of this process. A check that ends
// the copy is broken: its tally says how the copy ended, and the next check begins a new copy. So
// `check` must be able to make again whatever it keeps from one call to the next.
// case_of(i) is the id of the case of check i, for the text of a tally. Throws what `check` throws,
// and std::runtime_error if copies are killed from outside again and again. A copy costs some ten
// milliseconds, mostly for pages that both processes write, so check many cases together.
std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check);

// Puts a case to a plug-in in other forms (changes/changes.h), and judges the answers.
//
// A law of a plug-in is broken if a claim holds in the case and not in its form, which the oracle
// judges like any case. A detector that claims to be deterministic also breaks the law by different
// answers to the same calls. Different answers that its claims allow are only counted: one form may
// have a wider interval of time, or a false alarm.

struct FormCheck {
  // `premise` and `differs` count steps, and `broken` is 0 or 1; all 0 if the form did not apply.
  LawCount count;
  std::optional<FailureRecord> failure;  // of the form, if it breaks the law
  std::uint64_t disturbances = 0;
};

// Runs the form of a case in the worker. Nothing is judged if the form does not apply, if the
// contract leaves some of its steps out, or if it runs out of time or memory. `run` is the run of
// the case. Throws StoreProblem if there is no worker. REQUIRES a contracted case of meshes in
// which all pairs count and whose run holds, and a law about a change of such cases.
FormCheck check_in_form(const Law& law, const Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker);

// Returns whether check_in_form() applies: the case is put to this detector in other forms.
bool has_forms(const DetectorUnderTest& detector, const Case& c);

// Runs the trials of a campaign in threads, each with a worker process of its own.

// Numbers of trials of the run. `stored_trials` counts the trials that an earlier call stored;
// `done_trials` includes them; `defects`, `undecided` and `disturbed` do not.
struct TrialProgress {
  std::uint64_t done_trials = 0, quota = 0, stored_trials = 0;
  std::uint64_t defects = 0, undecided = 0, disturbed = 0;
};
using OnTrial = std::function<void(const TrialProgress&)>;

struct TrialsEnd {
  bool complete = false;        // every planned trial of the run is in the store
  double seconds = 0;           // the time of this call
  std::uint64_t trials = 0;     // judged in this call
  std::string harness_problem;  // why the harness itself could not go on; empty: it could
  // The problem that ended the call early, if any: a store that could not be written, a worker that
  // could not be started (the system gives no process, or the plug-in does not load any more), too
  // little memory.
  std::optional<Problem> problem;
};

// Makes and judges the trials that are not in the store yet, from the families in turn, until all
// are done or the deadline is over. Every record is stored as soon as it is complete, so that a
// killed run loses only the cases being judged. The records do not depend on the number
// of jobs. `progress` is called from one thread at a time. `only` gives the ids of the trials that
// count as planned; if it is null, all trials of the run count.
//
// Throws StoreProblem if the store cannot even be read at the beginning; so it is for campaign/
// alone.
TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const OnTrial& progress, const std::set<std::string>* only = nullptr);

// Returns the case of a failure as it is stored: with the options of its configuration.
Case failing_case(const Case& c, const Configuration& configuration,
                  const DetectorUnderTest& detector, const Failure& failure);
// Returns the failure as it is stored, under the id of the case. `flaky`: a second run does not
// show it.
FailureRecord stored_failure(Source source, const Case& c, const Configuration& configuration,
                             const DetectorUnderTest& detector, const Failure& failure, bool flaky,
                             const std::string& output);

// Throw StoreProblem if there was no worker; so both are for campaign/ alone.
void throw_if_not_run(const CaseResults& results);
void throw_if_not_run(const CaseRun& run);

}  // namespace assay::properties
