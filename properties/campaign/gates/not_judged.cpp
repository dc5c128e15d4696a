#include "properties/campaign/gates/not_judged.h"

#include <fmt/format.h>

#include <algorithm>

namespace assay::properties {
namespace {

// At most one collision in this many may come without a time.
constexpr std::uint64_t seldom = 100;

// Says why a claim was not judged. Empty if it was judged.
std::string reason_against(Claim claim, const Contract& contract, const StepMeasures& m) {
  switch (claim) {
    case Claim::no_spurious:
      return contract.margin > 0 ? "the contract has a margin" : "";
    case Claim::first_pairs:
    case Claim::all_pairs:
      if (!contract.reports_pairs) return "the detector reports no pairs";
      break;
    case Claim::first_time:
      if (seldom * m.without_time > m.collisions)
        return fmt::format("its interval is wider than {} in {} of {} collisions",
                           widest_stated_time, m.without_time, m.collisions);
      break;
    case Claim::candidates:
      return m.least_candidates == 0 ? "no step had a contact" : "";
    case Claim::deterministic:
    case Claim::total:
      return "";
    default:
      break;
  }
  return m.contact_steps == 0 ? "no step had a contact" : "";
}

}  // namespace

std::vector<NotJudged> not_judged(const std::vector<std::string>& claims, const Contract& contract,
                                  const StepMeasures& measures) {
  std::vector<NotJudged> list;
  for (const Claim claim : all_claims()) {
    if (std::find(claims.begin(), claims.end(), name_of(claim)) == claims.end()) continue;
    auto reason = reason_against(claim, contract, measures);
    if (!reason.empty()) list.push_back({name_of(claim), std::move(reason)});
  }
  return list;
}

std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures) {
  if (detector.built_in || detector.configurations.empty()) return {};
  return not_judged(detector.configurations[0].claims, detector.contract, measures);
}

std::vector<NotJudged> not_judged(const RunFindings& findings) {
  return not_judged(findings.run.detector, measures_in(findings.tally.counts));
}

std::vector<std::string> judged_claims(const RunFindings& findings) {
  std::vector<std::string> judged;
  if (findings.run.detector.configurations.empty()) return judged;
  const auto left = not_judged(findings);
  for (const auto& claim : findings.run.detector.configurations[0].claims) {
    const bool is_left = std::any_of(left.begin(), left.end(),
                                     [&](const NotJudged& one) { return one.claim == claim; });
    if (!is_left) judged.push_back(claim);
  }
  return judged;
}

}  // namespace assay::properties
