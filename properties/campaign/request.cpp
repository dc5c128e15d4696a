#include "properties/campaign/request.h"

#include <fmt/format.h>

#include <algorithm>

namespace assay::properties {

RunDeadline deadline_in(RunDeadline begin, double seconds) {
  constexpr double longest = 1e8;
  if (seconds > longest) return RunDeadline::max();
  return begin +
         std::chrono::duration_cast<RunDeadline::duration>(std::chrono::duration<double>(seconds));
}

RunDeadline deadline_after(RunDeadline begin, const CampaignPlan& plan, double share) {
  return plan.seconds == 0 ? RunDeadline::max() : deadline_in(begin, share * plan.seconds);
}

std::uint64_t planned_trial_count(const CampaignPlan& plan, std::uint64_t shares) {
  std::uint64_t count = 0;
  for (const auto& stratum : plan.strata) count += share_of(stratum.cases, shares);
  return count;
}

namespace {

// So many cases that an archive fills, and not so many lanes that they cannot be told one by one.
std::uint64_t size_of_lane(std::uint64_t cases) {
  constexpr std::uint64_t least = 500, most_lanes = 256;
  return std::max(least, share_of(cases, most_lanes));
}

}  // namespace

std::uint64_t search_lanes(std::uint64_t cases) { return share_of(cases, size_of_lane(cases)); }

std::uint64_t cases_of_lane(std::uint64_t cases, std::uint64_t lane) {
  const auto size = size_of_lane(cases);
  return std::min(size, cases - lane * size);
}

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

}  // namespace assay::properties
