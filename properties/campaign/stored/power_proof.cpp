#include "properties/campaign/stored/power_proof.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {
namespace {

bool is_below(const std::filesystem::path& folder, const std::filesystem::path& top) {
  std::error_code ignored;
  const auto inner = std::filesystem::weakly_canonical(folder, ignored);
  const auto outer = std::filesystem::weakly_canonical(top, ignored);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// What keeps the findings from being a proof for the plan.
std::string lack_of(const RunFindings& proof, const BoundRun& build, const CampaignPlan& plan) {
  const auto &digests = proof.run.digests, &ours = build.digests;
  if (digests.program != ours.program || digests.worker != ours.worker ||
      digests.generator != ours.generator)
    return "is of another build of assay";
  if (!proof.evidence.power.empty()) return "took its own proof from another run";
  if (proof.planted() != build.planted_faults || proof.found() != build.planted_faults)
    return fmt::format("shows {} of {} planted faults found", proof.found(), build.planted_faults);
  for (const auto& fault : proof.evidence.faults) {
    if (fault.status == FaultStatus::equivalent && fault.found())
      return fmt::format("found {}, which is registered as equivalent", fault.fault);
    if (fault.time_over) return fmt::format("was over before {} had all of its cases", fault.fault);
    if (!fault.is_whole(plan))
      return fmt::format("gave each fault {} cases of {} seeds, campaign {} asks for {} of {}",
                         fault.cases, fault.needed.size(), plan.name, plan.fault_cases,
                         plan.fault_seeds);
  }
  return "";
}

}  // namespace

std::optional<std::string> take_power(const std::filesystem::path& folder,
                                      const std::filesystem::path& out, CampaignRequest& request) {
  if (request.plan.fault_cases == 0)
    return fmt::format("campaign {} plants no faults: no proof of them is needed",
                       request.plan.name);
  if (is_below(folder, out))
    return fmt::format("{}: a proof must lie outside of the folder that the run writes",
                       folder.string());
  std::string problem;
  const auto proof = read_findings(folder, problem);
  if (!proof) return problem;
  const auto build = read_binding(binding_of(request), folder);
  const auto lack = lack_of(*proof, build, request.plan);
  if (!lack.empty()) return fmt::format("{}: the run {}", folder.string(), lack);
  const auto& run = proof->run;
  request.power =
      PowerProof{{run.plan.name, run.detector.name, run.seed, run.digests.program.value_or(""),
                  run.digests.worker.value_or(""), run.digests.generator, proof->rows},
                 proof->evidence.faults};
  for (auto& fault : request.power->faults) fault.shard = power_shard;
  return std::nullopt;
}

}  // namespace assay::properties
