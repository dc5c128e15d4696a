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
  std::string explanation;          // how the run ended, if it did not complete
  std::uint64_t disturbances = 0;   // how often it was killed from outside and repeated
  std::vector<StepDiff> steps;      // only of a completed run
  std::size_t left_out_misses = 0;  // steps that only the contract saves from being a miss
};

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

// The diff of step s of a run: its answer (agreement.h) and its candidates (judge_candidates).
// REQUIRES a run that has this step.
StepDiff compare_step(const CaseRun& run, std::size_t s, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles);

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
// Without judgements only these are judged. REQUIRES judgements of the same contracted case.
JudgedRun judge_run(const corpus::Case& c, const CaseRun& run,
                    std::span<const oracle::StepJudgement> judgements, const Claims& claims,
                    const Contract& contract, const CaseRun* again = nullptr);

}  // namespace assay::properties
