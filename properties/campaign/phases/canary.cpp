#include "properties/campaign/phases/canary.h"

#include <fmt/format.h>

#include "properties/campaign/database/store_problem.h"
#include "properties/faults/fault.h"
#include "properties/generators/families.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

Canary meet_canary(const CampaignRequest& request) {
  // A planted fault that many cases show, so that a run that does not find it finds nothing.
  constexpr std::string_view canary = "pair/zero-zero-dropped";
  constexpr std::uint64_t most_cases = 400;
  Canary result{std::string(canary), text_of(request.shard), {}};
  const Fault* fault = find_fault(canary);
  if (!fault) return result;
  const DetectorUnderTest detector = built_in_detector();
  const Configuration configuration{"canary", fault->options, result.fault};
  WorkerProcess worker(request.worker, std::nullopt, {request.plan.case_seconds, 0});
  const auto known = families();
  for (std::uint64_t i = 0; i < most_cases; ++i) {
    const Family& family = known[i % known.size()];
    const auto made = make_case(
        family, fmt::format("{}:{}.canary:{}:{}", request.plan.name, request.seed, family.name, i));
    const auto run = worker.run(made.c, {&configuration, 1});
    if (run[0].end == RunEnd::not_run) throw StoreProblem(run[0].explanation);
    const auto verdict = judge_trial(made.c, judge_case(made.c), run[0], configuration, detector);
    // A worker that dies does not show that a defect was seen.
    if (run[0].end != RunEnd::completed || verdict.outcome != Outcome::defect) continue;
    result.found_after = i + 1;
    return result;
  }
  return result;
}

}  // namespace assay::properties
