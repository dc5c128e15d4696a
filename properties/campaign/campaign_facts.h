// What a run as a whole rests on: its canary, its planted faults, its laws.
#pragma once

#include "properties/campaign/fault_hunt.h"

namespace assay::properties {

std::size_t planted_count();

// A planted fault that every run must find, on the way that the detector under test goes.
struct CanaryResult {
  std::string fault;
  std::optional<std::uint64_t> found_after;  // cases
};
CanaryResult meet_canary(const CampaignRequest& request);

// Laws whose premise held less often than wanted, or was close in less than a quarter of the cases:
// one line each. None when 0 are wanted.
std::vector<std::string> starved_laws(const Counts& counts, std::uint64_t wanted_premises);

// How many laws were broken.
std::uint64_t broken_laws(const Counts& counts);

}  // namespace assay::properties
