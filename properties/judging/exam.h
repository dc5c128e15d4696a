// The exam: gives a case to a detector, and judges the detector's answers by the oracle. All
// verdicts on cases are made here; the callers store and show them.
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
// configuration, except `truth`, which has one item for each step.
struct CaseResults {
  Case c;  // as fitted to the contract
  std::vector<StepJudgement> truth = {};
  std::vector<CaseRun> runs = {};
  std::vector<CaseRun> again = {};  // second runs; empty if there are none
  std::vector<Verdict> verdicts = {};
  // Wall clock of the oracle, and of the first runs together.
  std::uint64_t oracle_us = 0, detector_us = 0;

  // Returns the second run in this configuration; null if there is none.
  const CaseRun* second(std::size_t configuration) const {
    return again.empty() ? nullptr : &again[configuration];
  }
  // Returns the output of the detector in the first run, or, if that is empty, in the second run.
  const std::string& output(std::size_t configuration) const;
  // Returns why there was no worker for a run. Empty if all runs took place.
  std::string why_not_run() const;
};

// The detector to be examined, its configurations, and the workers that run it.
struct Exam {
  const DetectorUnderTest& detector;
  std::span<const Configuration> configurations;
  // Runs the detector. Null: the built-in detector runs in this process, which a crash then ends.
  WorkerProcess* worker = nullptr;
  // Runs each case again, in another process. Null: there is no second run.
  WorkerProcess* second = nullptr;
  int oracle_jobs = 1;
  // If set, a case to which the detector gave no answer is not judged by the oracle, which takes
  // most of the time.
  bool needs_an_answer = false;
};

// The three parts of examine(): run the case, run it again, and judge both runs. All parts REQUIRE
// a contracted case. If results.truth has judgements already, judge() uses these.
void run_first(const Exam& exam, CaseResults& results);
void run_again(const Exam& exam, CaseResults& results);
void judge(const Exam& exam, CaseResults& results);

CaseResults examine(const Exam& exam, Case c);
// Examines several cases and returns their results in order. The worker gets all cases at once; the
// second worker gets them at once in the opposite order. The output and the time of a single case
// are not known. REQUIRES a worker.
std::vector<CaseResults> examine(const Exam& exam, std::vector<Case> cases);

// Runs the case in one configuration and judges nothing. REQUIRES a contracted case.
CaseRun run_alone(WorkerProcess& worker, const Case& c, const Configuration& configuration);

// Returns the oracle's judgement of every step of a case. The relation of the case decides which
// pairs count.
std::vector<StepJudgement> judge_case(const Case& c);
// Returns the oracle's judgement of every step under the contract; for a query (query_case.h) only
// its two features are judged. REQUIRES a contracted case.
std::vector<StepJudgement> judge_case(const Case& c, const Contract& contract, int jobs = 1);

// Returns the oracle's facts about a step of this case under the contract; for a query
// (query_case.h), under on_queries(contract).
StepTruth truth_of(const Case& c, const StepJudgement& judgement, const Contract& contract);

// Returns the verdict on a run. It depends on the end of the run, on the answers to its steps
// (judge_step), and on a second run `again`, if there is one:
// - A crash breaks `total`. A refusal breaks `total` too, except if the case is expected to be
//   refused. If `total` is not claimed, a crash or such a refusal is Outcome::error.
// - A mesh that the detector refused as beyond its capacity is Outcome::refused if it has more
//   triangles than the capacity; if it has not, the refusal is judged as above. If some steps are
//   Outcome::refused and the rest holds, the run is Outcome::refused.
// - A hang, or a lack of memory, is undecided.
// - A run that did not take place is Outcome::error.
// - A second run that crashes breaks `total`. A second run with other answers breaks
//   `deterministic`. If the second run did not take place, the verdict is Outcome::error.
//
// If `judgements` is empty, the steps are not judged. Verdict::failure is not set. REQUIRES
// judgements of the same contracted case.
Verdict judge_run(const Case& c, const CaseRun& run, std::span<const StepJudgement> judgements,
                  const Claims& claims, const Contract& contract, const CaseRun* again = nullptr);

// The results of a case of the corpus, and the expected facts of the case that do not hold.

struct CaseCheck : CaseResults {
  std::vector<std::string> broken_facts = {};  // one line for each fact that does not hold
};

// Examines a case of the corpus in this process, with the options that the case states
// (case_options.h); `culling` and `arithmetic`, if given, replace the stated options. If the
// culling uses views, the detector gets the view primitive of the case.
//
// Compares with the expected facts: the refusal or the answer, the first time, the pair set (of
// detector and oracle), and the view signs (of the oracle, and of the detector if it tested the
// triangle). Also checks that detector and oracle agree. The detector's answer, pairs and signs are
// judged by the claims of its arithmetic.
CaseCheck check_case(const Case& c, std::optional<Culling> culling = {}, int jobs = 1,
                     std::optional<Arithmetic> arithmetic = {});

}  // namespace assay::properties
