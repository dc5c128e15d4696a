// The random trials of a campaign: the case of each, what is counted of it, and their run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
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

// A case of a family, and what the contract takes of it.
struct TrialCase {
  RandomCase source;
  // The case as the detector and the oracle are given it; nothing if no attempt led to a case that
  // the contract takes.
  std::optional<corpus::Case> input;
  std::uint64_t redrawn = 0;         // cases before this one, which did not serve
  std::uint64_t steps_left_out = 0;  // steps of this case that the contract leaves out
};

// The case of a trial id. If the contract takes none of its steps, the next ids
// "quick:1:broken:3~1", "~2", ... are tried until it takes some, so that a stratum has as many
// judged cases under every contract. Of a query, and under a contract that leaves contacts out,
// every fourth case has to have a contact that counts, and is drawn again until it has one. At most
// most_redrawn attempts are made, each deterministic; of them at most most_without_contact on cases
// that the contract takes, and then the last of these stays. The case is brought into the contract
// (below). Under a contract with a separation every second case is aimed at that (parts.h),
// and a case of which every step starts within it does not serve. Without a contract this is, of a
// mesh, the case of the id.
inline constexpr std::uint64_t most_redrawn = 200, most_without_contact = 40;
TrialCase case_within(const Contract& contract, const Family& family, const std::string& id);

// The case scaled by a power of two, so that the contract may take it. Its features can hardly lie
// start_distance apart if the whole mesh is smaller than eight times that, so it becomes that
// large, if a range of the contract allows it. With a separation the mesh becomes twice to 512
// times as large as that. Of a mesh of more than 400 triangles the middle one of its edges is
// looked at in place of the mesh, and becomes twice to 8 times as large as the separation. If the
// contract has a range, the case is scaled until its largest coordinate fits, or until its shortest
// edge does.
corpus::Case brought_into_contract(corpus::Case c, const Contract& contract);

// Finds the cases for which Start::clean may be used, because what the caller then vouches for is
// true.

// Whether the oracle calls every triangle clean (L9, detector/LAWS.md) in every step of the case
// that is a new start. For an unclosed mesh that depends on where the built-in detector puts its
// apexes, so it is asked for them, in a copy of this process, in which a crash does no harm.
bool starts_clean(const corpus::Case& c);

// Whether trial `index` of a family vouches for the start of its case. That is done for the
// built-in detector, in every second one of the trials that may. A large mesh is not looked at.
bool is_vouched_for(const DetectorUnderTest& detector, const corpus::Case& c, std::uint64_t index);

// The same configurations, with start clean in place of start verified.
std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations);

// What a campaign counts of a case besides its outcome: how far it goes, tags, set pairs of
// contacts, and laws, of the built-in detector and of a plug-in.

// How far the cases go on which a detector is tried. Beyond that nothing is known of it.

// The extremes of a case whose steps the oracle judged so. Costs O(N + M), and compares each frame
// with one other. REQUIRES triangles of which a detector can be made.
Extremes extremes_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth);

// The places in steps_of(c) of the steps that do not go on from a committed one.
std::vector<std::size_t> new_starts(const corpus::Case& c);

struct CaseTally {
  TrialCounts counts;
  std::vector<FailureRecord> failures;  // laws
};

// A case that the built-in detector was examined on, in these configurations.
struct TallyInput {
  const CaseResults& results;
  std::span<const Configuration> configurations;
  std::span<const std::string> tags = {};
  bool with_laws = true;
};

// Counts each of the cases. If `with_laws` is set, the laws are checked in each configuration that
// has view sets and asks for all pairs; those of all cases together, in one copy of this process
// (check_in_copies).
std::vector<CaseTally> tally_cases(std::span<const TallyInput> cases);

// The reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

// Checks laws where a crash of the detector does no harm. A law runs the built-in detector again,
// in this program; if that crashes, the law is broken, and all other checks go on.

// Runs check(0) to check(count - 1), in this order, in a copy of this process. A check that ends
// the copy is broken: its tally says how the copy ended, and the next check begins a new copy. So
// whatever `check` keeps from one call to the next, it must be able to make again.
// case_of(i) is the id of the case that check i is about, for the words of a tally. Throws what
// `check` throws, and std::runtime_error if copies are killed from outside again and again. A copy
// costs some ten milliseconds, mostly for pages that both processes write, so whoever has many
// cases checks them together.
std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check);

// Puts a case to a plug-in in other forms (changes/changes.h), and judges what it answers.
//
// A law of a plug-in is broken if a claim holds in the case and not in its form: the form is judged
// by the oracle like any case. A detector that claims to be deterministic breaks it also by other
// answers to the same calls. Other answers that its claims allow are counted alone: an interval of
// time may be wider in one form, and a collision may be a false alarm in one form.

struct FormCheck {
  // Premise and differs are steps, and broken is 0 or 1; nothing if the form did not apply.
  LawCount count;
  std::optional<FailureRecord> failure;  // of the form, if the law is broken
  std::uint64_t disturbances = 0;
};

// Runs the form of a case in the worker. Nothing is judged if it does not apply, if the contract
// leaves some of its steps out, or if it runs out of time or memory. `run` is the run of the case.
// Throws StoreProblem if there is no worker. REQUIRES a contracted case of meshes in which all
// pairs count, and whose run holds, and a law about a change of such.
FormCheck check_in_form(const Law& law, const corpus::Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker);

// Whether cases of this detector are put to it in other forms, and this is such a case.
bool has_forms(const DetectorUnderTest& detector, const corpus::Case& c);

// Runs the trials of a campaign in threads, each with a worker process of its own.

// Numbers of trials of the run. `stored_trials` counts those that an earlier call stored;
// `done_trials` includes them, the numbers of the second line do not.
struct TrialProgress {
  std::uint64_t done_trials = 0, quota = 0, stored_trials = 0;
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
FailureRecord stored_failure(Source source, const corpus::Case& c,
                             const Configuration& configuration, const DetectorUnderTest& detector,
                             const Failure& failure, bool flaky, const std::string& output);

// Both throw StoreProblem if there was no worker; so they are for campaign/ alone.
void throw_if_not_run(const CaseResults& results);
void throw_if_not_run(const CaseRun& run);

}  // namespace assay::properties
