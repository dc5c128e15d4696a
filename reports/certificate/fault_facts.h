// What the stored facts of a planted fault say (evidence.h), the same for certificate and page.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace assay::reports {

// needed: for each seed the random cases that it took, null where it was not found. The median;
// null where at least half of the seeds did not show it.
nlohmann::ordered_json median_of_needed(const nlohmann::ordered_json& needed);

// By its curated case, or by a random one under any seed (FaultResult::found).
bool is_found(const nlohmann::ordered_json& facts);

}  // namespace assay::reports
