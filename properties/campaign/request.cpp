#include "properties/campaign/request.h"

#include <fmt/format.h>

#include <algorithm>

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

namespace {

// So many cases that an archive fills, and not so many lanes that they cannot be told one by one.
std::uint64_t size_of_lane(const CampaignPlan& plan) {
  constexpr std::uint64_t least = 500, most_lanes = 256;
  return std::max(least, (plan.search + most_lanes - 1) / most_lanes);
}

}  // namespace

std::uint64_t search_lanes(const CampaignPlan& plan) {
  const auto size = size_of_lane(plan);
  return (plan.search + size - 1) / size;
}

std::uint64_t cases_of_lane(const CampaignPlan& plan, std::uint64_t lane) {
  const auto size = size_of_lane(plan);
  return std::min(size, plan.search - lane * size);
}

std::uint64_t planned_lanes(const CampaignPlan& plan, const Shard& shard) {
  std::uint64_t count = 0;
  for (std::uint64_t lane = 0; lane < search_lanes(plan); ++lane)
    count += shard.holds(lane) ? 1 : 0;
  return count;
}

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

}  // namespace assay::properties
