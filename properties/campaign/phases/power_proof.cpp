#include "properties/campaign/phases/power_proof.h"

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

bool is_of_build(const RunFindings& proof, const BoundRun& build) {
  const auto &digests = proof.run.digests, &ours = build.digests;
  return digests.program == ours.program && digests.worker == ours.worker &&
         digests.generator == ours.generator;
}

// Says what keeps the findings from being a proof for the plan. Empty if nothing does.
std::string lack_of(const RunFindings& proof, const BoundRun& build, const CampaignPlan& plan) {
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

Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request) {
  if (request.plan.fault_cases == 0) {
    return Problem{
        fmt::format("campaign {} plants no faults: no proof of them is needed", request.plan.name)};
  }
  if (is_below(folder, out)) {
    return Problem{fmt::format("{}: a proof must lie outside of the folder that the run writes",
                               folder.string())};
  }
  const auto read = read_findings(folder);
  if (!read) return read.error();
  const RunFindings& findings = read.value();
  const auto build = read_binding(binding_of(request), folder);
  if (!build) return build.error();
  if (!is_of_build(findings, build.value())) {
    return Problem{fmt::format("{}: the run is of another build of assay", folder.string())};
  }
  const auto lack = lack_of(findings, build.value(), request.plan);
  if (!lack.empty()) return Problem{fmt::format("{}: the run {}", folder.string(), lack)};
  const auto& run = findings.run;
  return PowerProof{{run.plan.name, run.detector.name, run.seed, run.digests.program.value_or(""),
                     run.digests.worker.value_or(""), run.digests.generator, findings.rows},
                    findings.evidence.faults};
}

}  // namespace assay::properties
