// The exam: puts a case to a detector, and judges its answers by the oracle. All verdicts on cases
// come from here; their use is the caller's affair.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/judging/contracted_case.h"
#include "properties/judging/subject.h"
#include "properties/judging/verdict.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// The results of the oracle and the detector on one case. Lists have one item for each
// configuration, except `truth`, which has one for each step.
struct CaseResults {
  Case c;  // as fitted to the contract
  std::vector<StepJudgement> truth = {};
  std::vector<CaseRun> runs = {};
  std::vector<CaseRun> again = {};  // second runs; empty if there are none
  std::vector<Verdict> verdicts = {};
  // Time by the clock: of the oracle and of the first runs.
  std::uint64_t oracle_us = 0, detector_us = 0;

  // Returns the second run in this configuration, or null.
  const CaseRun* second(std::size_t configuration) const {
    return again.empty() ? nullptr : &again[configuration];
  }
  // Returns the output of the detector in the first run or, if that was silent, in the second.
  const std::string& output(std::size_t configuration) const;
  // Returns why a run did not take place: there is no worker. Empty if all runs took place.
  std::string why_not_run() const;
};

// The detector to be examined, the configurations, and the way to run it.
struct Exam {
  const DetectorUnderTest& detector;
  std::span<const Configuration> configurations;
  // Runs the detector. Null: the built-in one runs in this process, where a crash ends the process.
  WorkerProcess* worker = nullptr;
  // Runs each case again, in another process. Null: there is no second run.
  WorkerProcess* second = nullptr;
  int oracle_jobs = 1;
  // If set, the oracle, which takes most of the time, is not asked about a case without an answer.
  bool needs_an_answer = false;
};

// Examine a case in three parts: run it, run it again, and judge both runs. All parts REQUIRE a
// contracted case. The oracle is not asked again for judgements that are there.
void run_first(const Exam& exam, CaseResults& results);
void run_again(const Exam& exam, CaseResults& results);
void judge(const Exam& exam, CaseResults& results);

CaseResults examine(const Exam& exam, Case c);
// Examines cases, in order. The worker gets all of them at once; so does the second worker, from
// the last to the first. The outputs and times of single cases are not told apart.
std::vector<CaseResults> examine(const Exam& exam, std::vector<Case> cases);

// Runs the case in one configuration and judges nothing. REQUIRES a contracted case.
CaseRun run_alone(WorkerProcess& worker, const Case& c, const Configuration& configuration);

// Returns the oracle's judgement of every step of a case, for the pairs that count by its relation.
std::vector<StepJudgement> judge_case(const Case& c);
// Returns the judgements under the contract; for a query (query_case.h) only the query is judged.
// REQUIRES a contracted case.
std::vector<StepJudgement> judge_case(const Case& c, const Contract& contract, int jobs = 1);

// Returns the oracle's facts about a step of this case under the contract. For a query
// (query_case.h), adjacency leaves nothing out.
StepTruth truth_of(const Case& c, const StepJudgement& judgement, const Contract& contract);

// Judges a run. The way in which the run ended decides first:
// - A crash breaks `total`, and so does a refusal, unless the case is expected to be refused. If
//   `total` is not claimed, both are Outcome::error.
// - A mesh that is refused as beyond the capacity is Outcome::refused if it has more triangles than
//   the capacity; else that is a refusal like any other. A run is Outcome::refused if every step
//   is.
// - A hang, or a lack of memory, is undecided.
// - A run that did not take place is Outcome::error.
// - `again` is a second run. It breaks `total` if it crashes, and `deterministic` if it differs. If
//   it did not take place, that is Outcome::error.
//
// Without judgements only the points above are judged. The verdict does not describe a failure.
// REQUIRES judgements of the same contracted case.
Verdict judge_run(const Case& c, const CaseRun& run, std::span<const StepJudgement> judgements,
                  const Claims& claims, const Contract& contract, const CaseRun* again = nullptr);

// The results of a case of the corpus, and the comparison with its expected facts.

struct CaseCheck : CaseResults {
  std::vector<std::string> broken_facts = {};  // one line for each fact that does not hold
};

// Runs a case of the corpus through detector and oracle in this process, with its own options
// (case_options.h); `culling` and `arithmetic` replace those of the case if they are given. The
// case's view primitive is used if the culling uses views.
//
// The facts compared are: refusal or answer, first time, pair set (of detector and oracle), view
// signs (of the detector if it tested the triangle, always of the oracle), and the agreement of
// detector and oracle. The detector's answer, pairs and signs are judged by the claims of its
// arithmetic.
CaseCheck check_case(const Case& c, std::optional<Culling> culling = {}, int jobs = 1,
                     std::optional<Arithmetic> arithmetic = {});

}  // namespace assay::properties
