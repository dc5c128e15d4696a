// Compares the candidate pairs of a broad phase with the contacts that there are.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "properties/judging/agreement.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// Adds to the diff of a step what its candidates show: each pair in contact that counts under the
// contract has to be among them. If there are none, or the oracle was stopped, a step that would
// hold is undecided. REQUIRES a judgement by asked_features(contract). O(n) in both numbers of
// pairs.
void judge_candidates(const CandidatePairs& candidates, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles, StepDiff& diff);

// The diff of a step of a library of candidates alone, which has no answer: it holds, or was an
// error, which breaks `total`.
StepDiff diff_without_answer(const detector::StepResult& result, const Claims& claims);

}  // namespace assay::properties
