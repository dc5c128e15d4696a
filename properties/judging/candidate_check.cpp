#include "properties/judging/candidate_check.h"

#include <algorithm>

#include "properties/judging/step_truth.h"

namespace assay::properties {

void judge_candidates(const CandidatePairs& candidates, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles, StepDiff& diff) {
  if (!claims.has(Claim::candidates)) return;
  if (candidates) {
    const StepTruth truth = truth_of(judgement, contract, triangles);
    auto ours = candidates->begin();
    for (const auto& contact : truth.pairs) {
      while (ours != candidates->end() && *ours < contact.pair) ++ours;
      const bool is_there = ours != candidates->end() && *ours == contact.pair;
      if (!is_there) diff.missing_candidates.push_back(contact);
    }
    diff.candidates = {candidates->size(), truth.pairs.size()};
  }
  if (!diff.missing_candidates.empty()) {
    diff.broken.push_back(Claim::candidates);
    diff.outcome = Outcome::defect;
  } else if (diff.outcome == Outcome::holds && !(candidates && judgement.complete)) {
    diff.partial = true;
    diff.outcome = Outcome::undecided;
  }
}

StepDiff diff_without_answer(const detector::StepResult& result, const Claims& claims) {
  StepDiff diff;
  diff.has_answer = false;
  if (result.answer != detector::Answer::error) return diff;
  if (claims.has(Claim::total)) diff.broken.push_back(Claim::total);
  diff.outcome = claims.has(Claim::total) ? Outcome::defect : Outcome::error;
  return diff;
}

}  // namespace assay::properties
