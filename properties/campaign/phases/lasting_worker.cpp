#include "properties/campaign/phases/lasting_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "properties/campaign/ledger/store_problem.h"
#include "properties/campaign/phases/repetitions.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/judged_run.h"
#include "properties/queries/query_families.h"

namespace assay::properties {
namespace {

// Of each family: so many cases are remembered, and so many are looked at for them.
constexpr int colliding_of_a_family = 2, free_of_a_family = 1, most_looked_at = 6;
// After so many cases that have no answer any more none is asked again, because each may take the
// limit of a case.
constexpr std::uint64_t most_open = 3;

WorkerLimits limits_of(const CampaignRequest& request) {
  auto limits = request.worker_limits();
  limits.threads = threads_of_runs(request).front();
  return limits;
}

bool collides(const CaseRun& run) {
  return std::any_of(run.steps.begin(), run.steps.end(), [](const detector::StepResult& step) {
    return step.answer == detector::Answer::collision;
  });
}

}  // namespace

LastingWorker::LastingWorker(const CampaignRequest& request)
    : request_(request), process_(request.worker, request.plugin, limits_of(request)) {}

CaseRun LastingWorker::run(const corpus::Case& c) {
  auto run = std::move(process_.run(c, {&configuration(), 1}).front());
  if (run.end == RunEnd::not_run) throw StoreProblem(run.explanation);
  return run;
}

void LastingWorker::begin() {
  for (const auto& stratum : request_.plan.strata) {
    if (!is_size_family(stratum.family) && !put_first_cases(stratum)) return;
  }
}

// Returns whether another family may follow.
bool LastingWorker::put_first_cases(const StratumPlan& stratum) {
  const auto* family = find_family(stratum.family);
  int colliding = 0, free = 0, looked_at = 0;
  const auto cases = share_of(stratum.cases, request_.shares);
  for (std::uint64_t i = 0; i < cases && looked_at < most_looked_at; ++i) {
    if (colliding == colliding_of_a_family && free == free_of_a_family) break;
    ++looked_at;
    const auto id = trial_id(request_.plan, request_.seed, stratum.family,
                             trial_index(i, request_.seed, request_.shares));
    auto drawn = case_within(request_.detector.contract, *family, id);
    if (!drawn.seen) continue;
    auto first = run(*drawn.seen);
    if (first.end == RunEnd::beyond_capacity) continue;
    if (first.end != RunEnd::completed) return false;
    const bool is_colliding = collides(first);
    int& count = is_colliding ? colliding : free;
    if (count++ < (is_colliding ? colliding_of_a_family : free_of_a_family))
      remember(*drawn.seen, std::move(first));
  }
  return true;
}

void LastingWorker::remember(const corpus::Case& c, CaseRun first) {
  remembered_.push_back({c, std::move(first)});
}

AskedAgain LastingWorker::ask_again(Store& store) {
  AskedAgain row;
  for (; !remembered_.empty() && row.open < most_open; remembered_.pop_back()) {
    const auto& asked = remembered_.back();
    const auto again = run(asked.c);
    ++row.cases;
    row.steps += again.steps.size();
    if (!same_answers(asked.first, again)) judge_anew(asked, again, row, store);
  }
  store.set(to_row(row));
  return row;
}

void LastingWorker::judge_anew(const Remembered& asked, const CaseRun& run, AskedAgain& row,
                               Store& store) const {
  const auto& detector = request_.detector;
  const auto truth = judge_case(asked.c, detector.contract, request_.jobs);
  auto judged = judge_trial(asked.c, truth, run, configuration(), detector, &asked.first);
  if (judged.outcome == Outcome::undecided || judged.outcome == Outcome::error) ++row.open;
  if (!judged.failure) return;
  ++row.wrong;
  auto& failure = *judged.failure;
  failure.cause = "asked at the end";
  failure.explanation = fmt::format("{}, asked again at the end of the campaign: {}", asked.c.id,
                                    failure.explanation);
  store.add({fmt::format("{}{}", asked_again_in_id, asked.c.id), configuration().name,
             failure.signature(), failure.explanation,
             corpus::case_text(failing_case(asked.c, configuration(), detector, failure)), "", true,
             run.printed});
}

}  // namespace assay::properties
