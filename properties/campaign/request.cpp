#include "properties/campaign/request.h"

#include <fmt/format.h>

namespace assay::properties {

std::string text_of(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

RunDeadline deadline_in(RunDeadline begin, double seconds) {
  constexpr double longest = 1e8;
  if (seconds > longest) return RunDeadline::max();
  return begin +
         std::chrono::duration_cast<RunDeadline::duration>(std::chrono::duration<double>(seconds));
}

RunDeadline deadline_after(RunDeadline begin, const CampaignPlan& plan, double share) {
  return plan.seconds == 0 ? RunDeadline::max() : deadline_in(begin, share * plan.seconds);
}

std::uint64_t planned_cases(const StratumPlan& stratum, const Shard& shard) {
  return (stratum.cases + shard.count - shard.index) / shard.count;
}

std::uint64_t planned_trial_count(const CampaignPlan& plan, const Shard& shard) {
  std::uint64_t count = 0;
  for (const auto& stratum : plan.strata) count += planned_cases(stratum, shard);
  return count;
}

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

}  // namespace assay::properties
