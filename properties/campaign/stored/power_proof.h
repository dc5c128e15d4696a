// The proof that planted faults are found, taken from another run of the same build. Planted faults
// prove the harness of a build, not the detector that it judges, so a plug-in's run need not plant
// them again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "properties/campaign/request.h"

namespace assay::properties {

// Puts the proof in `folder` into the request. A line for the user where the folder holds no run or
// one of another build (program, worker and generator digests), where not every fault that is
// planted was found by that run itself, where it gave a fault fewer cases or seeds than the plan
// asks for, or where the plan plants none.
//
// REQUIRES that no code of a plug-in ran in this process's workers before: what it could write to
// is then read already. The folder may not be `out`, nor lie below it.
std::optional<std::string> take_power(const std::filesystem::path& folder,
                                      const std::filesystem::path& out, CampaignRequest& request);

}  // namespace assay::properties
