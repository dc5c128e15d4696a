#include "properties/campaign/campaign_facts.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/faults/fault.h"
#include "properties/generators/families.h"
#include "properties/laws/law.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

std::size_t planted_count() {
  const auto all = faults();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const Fault& fault) {
    return fault.status == FaultStatus::planted;
  }));
}

CanaryResult meet_canary(const CampaignRequest& request) {
  // One that many cases show: a run in which it hides is a run that sees nothing.
  constexpr std::string_view canary = "pair/zero-zero-dropped";
  constexpr std::uint64_t most_cases = 400;
  CanaryResult result;
  result.fault = canary;
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
    const auto verdict = judge_trial(made.c, judge_case(made.c), run[0], configuration, detector);
    if (verdict.outcome != Outcome::defect) continue;
    result.found_after = i + 1;
    return result;
  }
  return result;
}

namespace {

std::uint64_t count_of(const Counts& counts, std::string_view law, const char* what) {
  const auto found = counts.find(fmt::format("law:{}/{}", law, what));
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

std::vector<std::string> starved_laws(const Counts& counts, std::uint64_t wanted_premises) {
  std::vector<std::string> lines;
  if (wanted_premises == 0) return lines;
  for (const auto& law : laws()) {
    const auto premise = count_of(counts, law.name, "premise");
    const auto close = count_of(counts, law.name, "close");
    if (premise < wanted_premises) {
      lines.push_back(fmt::format("the premise of {} held {} times, {} are wanted", law.name,
                                  premise, wanted_premises));
    } else if (4 * close < premise) {
      lines.push_back(fmt::format("{} was close in {} of {} cases, a quarter is wanted", law.name,
                                  close, premise));
    }
  }
  return lines;
}

std::uint64_t broken_laws(const Counts& counts) {
  std::uint64_t broken = 0;
  for (const auto& law : laws()) broken += count_of(counts, law.name, "broken") > 0 ? 1 : 0;
  return broken;
}

}  // namespace assay::properties
