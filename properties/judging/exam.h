// The exam: a case is put to a detector, and what it answers is judged by the oracle. Whoever needs
// a verdict of a case asks here; what becomes of the verdict is the caller's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/subject.h"
#include "properties/judging/verdict.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// What the oracle and the detector say of one case; of the lists, one item for each configuration.
struct CaseResults {
  corpus::Case c;  // as the contract has it
  std::vector<oracle::StepJudgement> truth = {};
  std::vector<CaseRun> runs = {};
  std::vector<CaseRun> again = {};  // second runs; empty if there are none
  std::vector<Verdict> verdicts = {};
  // By the clock: of the oracle and of the first runs.
  std::uint64_t oracle_us = 0, detector_us = 0;

  // The second run in this configuration, or null.
  const CaseRun* second(std::size_t configuration) const {
    return again.empty() ? nullptr : &again[configuration];
  }
  // What the detector printed in the first run or, if that was silent, in the second.
  const std::string& output(std::size_t configuration) const;
  // Why a run did not take place: there is no worker. Empty if all did.
  std::string why_not_run() const;
};

// Who is asked, in which configurations, and how.
struct Exam {
  const DetectorUnderTest& detector;
  std::span<const Configuration> configurations;
  // Runs the detector. Null: the built-in one runs in this process, to which it does what it does.
  WorkerProcess* worker = nullptr;
  // Runs each case again, in another process. Null: there is no second run.
  WorkerProcess* second = nullptr;
  int oracle_jobs = 1;
  // If no step of a case has an answer, the oracle, which takes most of the time, is not asked.
  bool needs_an_answer = false;
};

// A case is examined in three parts: it is run, it is run again, and both runs are judged. All of
// them REQUIRE a contracted case. What is there already of the oracle's is not asked again.
void run_first(const Exam& exam, CaseResults& results);
void run_again(const Exam& exam, CaseResults& results);
void judge(const Exam& exam, CaseResults& results);

CaseResults examine(const Exam& exam, corpus::Case c);
// Examines cases, in order. They go to the worker together, and to the second one together from the
// last to the first. What they print, and how long they take, is not told apart.
std::vector<CaseResults> examine(const Exam& exam, std::vector<corpus::Case> cases);

// Runs the case in one configuration and judges nothing. REQUIRES a contracted case.
CaseRun run_alone(WorkerProcess& worker, const corpus::Case& c, const Configuration& configuration);

// The judgement of the oracle on every step of a case; pairs are those that count by its relation.
std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c);
// The same, for what the contract takes; for a query (query_case.h) only the query is judged.
// REQUIRES a contracted case.
std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c, const Contract& contract,
                                              int jobs = 1);

// The oracle's facts of a step of this case under the contract. Adjacency leaves nothing out of a
// query (query_case.h).
StepTruth truth_of(const corpus::Case& c, const oracle::StepJudgement& judgement,
                   const Contract& contract);

// The diff of a step, which is at this place of the run: its answer, its candidates and its limit
// (agreement.h). REQUIRES a run that has this step.
StepDiff judge_step(const CaseRun& run, std::size_t place, const LimitedStep& step,
                    const oracle::StepJudgement& judgement, const Claims& claims,
                    const Contract& contract);

// Judges a run. How it ended decides first:
// - A crash breaks `total`, and so does a refusal, unless the case is expected to be refused. If
//   `total` is not claimed they are Outcome::error.
// - A mesh that is refused as beyond the capacity is Outcome::refused if it has more triangles than
//   that, and so is a run of which every step is refused so; else it is a refusal as any other.
// - A hang, or a lack of memory, is undecided.
// - A run that did not take place is Outcome::error.
// - `again` is a second run. It breaks `total` if it crashes, and `deterministic` if it differs. If
//   it did not take place, that is Outcome::error.
//
// Without judgements only these are judged. The verdict does not describe a failure. REQUIRES
// judgements of the same contracted case.
Verdict judge_run(const corpus::Case& c, const CaseRun& run,
                  std::span<const oracle::StepJudgement> judgements, const Claims& claims,
                  const Contract& contract, const CaseRun* again = nullptr);

// Runs a case of the corpus through detector and oracle, and compares both with its expected
// facts.

struct CaseCheck : CaseResults {
  std::vector<std::string> broken_facts = {};  // one line for each fact that does not hold
};

// Runs the case in this process with its own options (case_options.h); `culling` and `arithmetic`
// replace the case's if they are given. The case's view primitive is used if the culling uses
// views.
//
// The facts compared are: refusal or answer, first time, pair set (of detector and oracle), view
// signs (of the detector if it tested the triangle, always of the oracle), and the agreement of
// detector and oracle. The detector's answer, pairs and signs are held to what its arithmetic
// claims.
CaseCheck check_case(const corpus::Case& c, std::optional<detector::Culling> culling = {},
                     int jobs = 1, std::optional<detector::Arithmetic> arithmetic = {});

}  // namespace assay::properties
