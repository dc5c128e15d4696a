#include "properties/judging/judged_run.h"

#include <algorithm>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

// The worse of two outcomes.
Outcome worse(Outcome a, Outcome b) {
  // A case of which a step is refused speaks for nothing, although its other steps hold.
  constexpr Outcome ascending[] = {Outcome::holds, Outcome::refused, Outcome::undecided,
                                   Outcome::error, Outcome::defect};
  const auto rank = [&](Outcome outcome) {
    return std::find(std::begin(ascending), std::end(ascending), outcome);
  };
  return rank(a) < rank(b) ? b : a;
}

void add_broken(JudgedRun& judged, Claim claim) {
  judged.outcome = Outcome::defect;
  const auto place = std::lower_bound(judged.broken.begin(), judged.broken.end(), claim);
  if (place == judged.broken.end() || *place != claim) judged.broken.insert(place, claim);
}

void not_answered(JudgedRun& judged, const Claims& claims) {
  if (claims.has(Claim::total)) {
    add_broken(judged, Claim::total);
  } else {
    judged.outcome = Outcome::error;
  }
}

// Which pairs of a case count, and which of them its contract tests, for the oracle.
struct AskedPairs {
  AskedPairs(const corpus::Case& c, const Contract& contract, int jobs)
      : tested(tested_pairs(contract, c.frames.front())),
        options{jobs, {}, {}, corpus::counted_of(c), &tested} {}
  detector::CountedPairs tested;
  oracle::JudgeOptions options;
};

std::vector<oracle::StepJudgement> judge_steps(const corpus::Case& c, const Contract& contract,
                                               int jobs) {
  const AskedPairs asked(c, contract, jobs);
  std::vector<oracle::StepJudgement> judgements;
  for (const auto& step : corpus::steps_of(c)) {
    judgements.push_back(
        judge_under(contract, {start_of(c, step), end_of(c, step)}, c.triangles, asked.options));
  }
  return judgements;
}

}  // namespace

std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c) {
  return judge_steps(c, {}, 1);
}

std::vector<oracle::StepJudgement> judge_case(const corpus::Case& c, const Contract& contract,
                                              int jobs) {
  if (const auto query = query_of(c)) return {judge_query(*query, contract)};
  return judge_steps(c, contract, jobs);
}

StepTruth truth_of(const corpus::Case& c, const oracle::StepJudgement& judgement,
                   const Contract& contract) {
  return truth_of(judgement, says_query(c) ? on_queries(contract) : contract, c.triangles);
}

StepDiff compare_step(const CaseRun& run, std::size_t s, const oracle::StepJudgement& judgement,
                      const Claims& claims, const Contract& contract,
                      const detector::TrianglesView& triangles) {
  if (is_over_capacity(run, s)) return diff_of_refusal(judgement, claims, contract, triangles);
  StepDiff diff = run.has_answers
                      ? compare(run.steps[s], judgement, claims, contract, triangles)
                      : diff_without_answer(run.steps[s], judgement, claims, contract, triangles);
  diff.oracle_complete = judgement.complete;
  const CandidatePairs none;
  const auto& candidates = s < run.candidates.size() ? run.candidates[s] : none;
  judge_candidates(candidates, judgement, claims, contract, triangles, diff);
  return diff;
}

JudgedRun judge_run(const corpus::Case& c, const CaseRun& run,
                    std::span<const oracle::StepJudgement> judgements, const Claims& claims,
                    const Contract& contract, const CaseRun* again) {
  JudgedRun judged;
  judged.explanation = run.explanation;
  judged.disturbances = run.disturbances + (again ? again->disturbances : 0);
  switch (run.end) {
    case RunEnd::completed:
      break;
    case RunEnd::crashed:
      not_answered(judged, claims);
      break;
    case RunEnd::refused:
      if (c.expected.answer != detector::Answer::error) not_answered(judged, claims);
      break;
    case RunEnd::beyond_capacity: {
      const StepLoad load = {static_cast<std::uint64_t>(c.triangles.rows()), 0, 0};
      if (beyond_capacity(contract, load)) {
        judged.outcome = Outcome::refused;
      } else {
        not_answered(judged, claims);
      }
      break;
    }
    case RunEnd::hung:
    case RunEnd::out_of_memory:
      judged.outcome = Outcome::undecided;
      break;
    case RunEnd::not_run:
      judged.outcome = Outcome::error;
      return judged;
  }
  const Contract of_case = says_query(c) ? on_queries(contract) : contract;
  const auto script = corpus::steps_of(c);
  std::optional<AskedPairs> asked;
  for (std::size_t s = 0; s < std::min(run.steps.size(), judgements.size()); ++s) {
    auto diff = compare_step(run, s, judgements[s], claims, of_case, c.triangles);
    if (s < run.limits.size() && !diff.refused) {
      if (!asked) asked.emplace(c, contract, 1);
      judge_limit(run.limits[s],
                  {{start_of(c, script[s]), end_of(c, script[s])}, c.triangles, asked->options},
                  judgements[s], claims, of_case, diff);
    }
    judged.outcome = worse(judged.outcome, diff.outcome);
    for (const auto claim : diff.broken) add_broken(judged, claim);
    judged.left_out_misses += diff.left_out_missed ? 1 : 0;
    judged.steps.push_back(std::move(diff));
  }
  if (!again) return judged;
  if (again->end == RunEnd::not_run) {
    judged.explanation = again->explanation;
    judged.outcome = worse(judged.outcome, Outcome::error);
  }
  if (again->end == RunEnd::crashed && run.end != RunEnd::crashed) {
    judged.explanation = again->explanation;
    not_answered(judged, claims);
  }
  const auto ended_by_itself = [](const CaseRun& one) {
    return one.end == RunEnd::completed || one.end == RunEnd::crashed ||
           one.end == RunEnd::refused || one.end == RunEnd::beyond_capacity;
  };
  if (claims.has(Claim::deterministic) && ended_by_itself(run) && ended_by_itself(*again) &&
      !same_answers(run, *again)) {
    add_broken(judged, Claim::deterministic);
  }
  return judged;
}

}  // namespace assay::properties
