// The exam: a case is put to a detector, and what it answers is judged by the oracle. Whoever needs
// a verdict of a case asks here; what becomes of the verdict is the caller's.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/judging/subject.h"
#include "properties/judging/trial.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// What the oracle and the detector say of one case; of the lists, one item for each configuration.
struct Examined {
  corpus::Case c;  // as the contract has it
  std::vector<oracle::StepJudgement> truth;
  std::vector<CaseRun> runs;
  std::vector<CaseRun> again;  // second runs; empty if there are none
  std::vector<JudgedTrial> trials;
  // By the clock: of the oracle and of the first runs.
  std::uint64_t oracle_us = 0, detector_us = 0;

  // The second run in this configuration, or null.
  const CaseRun* second(std::size_t configuration) const {
    return again.empty() ? nullptr : &again[configuration];
  }
  // What the detector printed in the first run or, if that was silent, in the second.
  const std::string& printed(std::size_t configuration) const;
  // Why a run did not take place: there is no worker. Empty if all did.
  std::string why_not_run() const;
};

// Who is asked, in which configurations, and how.
struct Exam {
  const DetectorUnderTest& detector;
  std::span<const Configuration> configurations;
  WorkerProcess* worker;  // runs the detector; null if its answers are there already
  // Runs each case again, in another process. Null: there is no second run.
  WorkerProcess* second = nullptr;
  int oracle_jobs = 1;
  // If no step of a case has an answer, the oracle, which takes most of the time, is not asked.
  bool needs_an_answer = false;
};

// A case is examined in three parts: it is run, it is run again, and both runs are judged. All of
// them REQUIRE a contracted case.
void run_first(const Exam& exam, Examined& examined);
void run_again(const Exam& exam, Examined& examined);
void judge(const Exam& exam, Examined& examined);

Examined examine(const Exam& exam, corpus::Case c);
// Examines cases, in order. They go to the worker together, and to the second one together from the
// last to the first. What they print, and how long they take, is not told apart.
std::vector<Examined> examine(const Exam& exam, std::vector<corpus::Case> cases);

// Runs the case in one configuration and judges nothing. REQUIRES a contracted case.
CaseRun run_alone(const Exam& exam, const corpus::Case& c, std::size_t configuration);

}  // namespace assay::properties
