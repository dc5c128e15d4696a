#include "reports/check/claims_tally.h"

#include <algorithm>

namespace assay::reports {

void ClaimsTally::add(const properties::StepDiff& diff, const detector::StepResult& result) {
  if (!plugin_) return;
  measures_ += properties::measures_of({&diff, 1}, {&result, 1});
  measures_.left_out_misses += diff.left_out_missed ? 1 : 0;
}

void ClaimsTally::tell(CheckOutcome& outcome, std::size_t steps_left_out) const {
  if (!plugin_) return;
  outcome.measures = measures_;
  outcome.measures.steps_left_out = steps_left_out;
  std::vector<std::string> claims;
  for (const auto claim : list_of(claims_on_steps(*plugin_))) claims.emplace_back(name_of(claim));
  outcome.not_judged = properties::not_judged(claims, plugin_->contract, outcome.measures);
  for (const auto& claim : claims) {
    const bool is_judged = std::none_of(outcome.not_judged.begin(), outcome.not_judged.end(),
                                        [&](const auto& one) { return one.claim == claim; });
    if (is_judged) outcome.held.push_back(claim);
  }
}

}  // namespace assay::reports
