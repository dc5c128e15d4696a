#include "reports/queries/query_judge.h"

#include <algorithm>
#include <chrono>

#include "properties/worker/plugin/query_case.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;

bool same_frames(const corpus::Case& a, const corpus::Case& b) {
  return a.frames[0] == b.frames[0] && a.frames[1] == b.frames[1];
}

}  // namespace

std::vector<JudgedQuery> QueryJudge::judge(std::span<const detector::FourPoints> queries) {
  std::vector<JudgedQuery> judged(queries.size());
  std::vector<std::size_t> places;
  std::vector<corpus::Case> cases;
  std::vector<detector::FourPoints> asked;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto given = properties::case_of_query(queries[i], "query");
    auto seen = properties::contracted(given, detector_.contract);
    if (!seen) continue;
    judged[i].is_within = true;
    judged[i].is_rounded = !same_frames(given, *seen);
    places.push_back(i);
    asked.push_back(*properties::query_of(*seen));
    cases.push_back(std::move(*seen));
  }
  // This starts the worker before the time is taken. If it does not start, the runs say why.
  [[maybe_unused]] const auto started = worker_.describe();
  const auto begin = Clock::now();
  auto runs = worker_.ask(asked);
  const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
  std::vector<properties::CaseRun> again;
  if (detector_.claims.deterministic) {
    std::reverse(asked.begin(), asked.end());
    again = second_.ask(asked);
    std::reverse(again.begin(), again.end());
  }
  const properties::Configuration configuration{"query", {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    JudgedQuery& one = judged[places[i]];
    const auto truth = properties::judge_case(cases[i], detector_.contract);
    auto verdict = properties::judge_trial(cases[i], truth, runs[i], configuration, detector_,
                                           again.empty() ? nullptr : &again[i]);
    measures_ += properties::measures_of(verdict.steps, runs[i].steps);
    one.contact = !truth[0].pairs.empty();
    one.first = truth[0].first;
    one.outcome = verdict.outcome;
    one.failure = std::move(verdict.failure);
    one.microseconds = took.count() / static_cast<double>(places.size());
    crashes_ += runs[i].end == properties::RunEnd::crashed ? 1 : 0;
    one.run = std::move(runs[i]);
  }
  return judged;
}

}  // namespace assay::reports
