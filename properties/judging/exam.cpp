#include "properties/judging/exam.h"

#include <algorithm>
#include <chrono>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

// Does the work, and returns how many microseconds it took.
template <class Work>
std::uint64_t time_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  const auto took = std::chrono::steady_clock::now() - begin;
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(took).count());
}

bool has_an_answer(const Examined& examined) {
  return std::any_of(examined.runs.begin(), examined.runs.end(),
                     [](const CaseRun& run) { return !run.steps.empty(); });
}

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

void add_broken(Verdict& judged, Claim claim) {
  judged.outcome = Outcome::defect;
  const auto place = std::lower_bound(judged.broken.begin(), judged.broken.end(), claim);
  if (place == judged.broken.end() || *place != claim) judged.broken.insert(place, claim);
}

void not_answered(Verdict& judged, const Claims& claims) {
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

const std::string& Examined::printed(std::size_t configuration) const {
  const auto& first = runs[configuration].printed;
  return first.empty() && !again.empty() ? again[configuration].printed : first;
}

std::string Examined::why_not_run() const {
  for (const auto* list : {&runs, &again}) {
    for (const auto& run : *list) {
      if (run.end == RunEnd::not_run) return run.explanation;
    }
  }
  return "";
}

void run_first(const Exam& exam, Examined& examined) {
  examined.detector_us = time_of([&] {
    if (exam.worker) {
      examined.runs = exam.worker->run(examined.c, exam.configurations);
    } else {
      for (const auto& configuration : exam.configurations)
        examined.runs.push_back(run_case(examined.c, configuration));
    }
  });
}

void run_again(const Exam& exam, Examined& examined) {
  if (exam.second) examined.again = exam.second->run(examined.c, exam.configurations);
}

void judge(const Exam& exam, Examined& examined) {
  const auto& [detector, configurations, worker, second, jobs, needs_an_answer] = exam;
  auto& [c, truth, runs, again, verdicts, oracle_us, detector_us] = examined;
  if (truth.empty() && (!needs_an_answer || has_an_answer(examined)))
    oracle_us = time_of([&] { truth = judge_case(c, detector.contract, jobs); });
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const auto claims = detector.claims_on(c, configurations[i]);
    auto& verdict = verdicts.emplace_back(
        judge_run(c, runs[i], truth, claims, detector.contract, examined.second(i)));
    if (verdict.outcome == Outcome::defect)
      verdict.failure = failure_of(verdict, c, truth, runs[i], configurations[i], detector);
  }
}

Examined examine(const Exam& exam, corpus::Case c) {
  Examined examined;
  examined.c = std::move(c);
  run_first(exam, examined);
  run_again(exam, examined);
  judge(exam, examined);
  return examined;
}

std::vector<Examined> examine(const Exam& exam, std::vector<corpus::Case> cases) {
  const auto runs = [&](WorkerProcess& worker) {
    auto all = worker.run(cases, exam.configurations);
    std::vector<std::vector<CaseRun>> by_case(cases.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      by_case[i / exam.configurations.size()].push_back(std::move(all[i]));
    return by_case;
  };
  auto first = runs(*exam.worker);
  std::vector<std::vector<CaseRun>> again(cases.size());
  if (exam.second) {
    std::reverse(cases.begin(), cases.end());
    again = runs(*exam.second);
    std::reverse(cases.begin(), cases.end());
    std::reverse(again.begin(), again.end());
  }
  std::vector<Examined> examined(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto& one = examined[i];
    one.c = std::move(cases[i]);
    one.runs = std::move(first[i]);
    one.again = std::move(again[i]);
    judge(exam, one);
  }
  return examined;
}

CaseRun run_alone(WorkerProcess& worker, const corpus::Case& c,
                  const Configuration& configuration) {
  return std::move(worker.run(c, {&configuration, 1}).front());
}

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

StepDiff judge_step(const CaseRun& run, std::size_t place, const LimitedStep& step,
                    const oracle::StepJudgement& judgement, const Claims& claims,
                    const Contract& contract) {
  const auto& triangles = step.triangles;
  if (is_over_capacity(run, place)) return diff_of_refusal(judgement, claims, contract, triangles);
  const auto& result = run.steps[place];
  StepDiff diff = run.has_answers
                      ? compare(result, judgement, claims, contract, triangles)
                      : diff_without_answer(result, judgement, claims, contract, triangles);
  diff.oracle_complete = judgement.complete;
  const CandidatePairs none;
  const auto& candidates = place < run.candidates.size() ? run.candidates[place] : none;
  judge_candidates(candidates, judgement, claims, contract, triangles, diff);
  if (place < run.limits.size())
    judge_limit(run.limits[place], step, judgement, claims, contract, diff);
  return diff;
}

Verdict judge_run(const corpus::Case& c, const CaseRun& run,
                  std::span<const oracle::StepJudgement> judgements, const Claims& claims,
                  const Contract& contract, const CaseRun* again) {
  Verdict judged;
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
  const detector::TrianglesView triangles(c.triangles);
  std::optional<AskedPairs> asked;
  for (std::size_t s = 0; s < std::min(run.steps.size(), judgements.size()); ++s) {
    if (!asked) asked.emplace(c, contract, 1);
    const detector::SteppedMesh motion{start_of(c, script[s]), end_of(c, script[s])};
    auto diff =
        judge_step(run, s, {motion, triangles, asked->options}, judgements[s], claims, of_case);
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
