// One run of a case, judged: the diffs of its steps, and what only the whole run shows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/judging/agreement.h"
#include "properties/judging/contracted_case.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

struct JudgedRun {
  Outcome outcome = Outcome::holds;
  std::vector<Claim> broken;        // in the order of Claim, each once
  std::string what;                 // how the run ended, where it did not complete
  std::uint64_t disturbances = 0;   // how often it was killed from outside, and began anew
  std::vector<StepDiff> steps;      // of a completed run
  std::size_t left_out_misses = 0;  // steps that only the contract saves from being a miss
};

// The oracle on every step of a case.
std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c,
                                              const oracle::JudgeOptions& options = {});
// The same, asked for what the contract takes; of a query (query_case.h) it alone. REQUIRES a
// contracted case.
std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c, const Contract& contract,
                                              int jobs = 1);

// The diff of step s of a run: its answer (agreement.h) and its candidates (candidate_check.h).
// REQUIRES a run that has this step.
StepDiff compare_step(const CaseRun& run, std::size_t s, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles);

// REQUIRES judgements of the same case, contracted. A crash or a refusal of a case that is not
// expected to be refused breaks `total` (where that is not claimed: Outcome::error); a hang, or the
// want of memory, is undecided; `again`, a second run, breaks `total` when it crashes and
// `deterministic` when it differs. A run that did not take place is Outcome::error. Without
// judgements only these are judged.
JudgedRun judge_run(const corpus::Case& c, const CaseRun& run,
                    std::span<const oracle::StepJudgement> judgements, const Claims& claims,
                    const Contract& contract, const CaseRun* again = nullptr);

}  // namespace assay::properties
