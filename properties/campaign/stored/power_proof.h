// The proof that planted faults are found, taken from another run of the same build. Planted faults
// prove the harness of a build, not the detector that it judges, so a plug-in's run need not plant
// them again.
#pragma once

#include <filesystem>

#include "properties/campaign/request.h"
#include "properties/problem.h"

namespace assay::properties {

// The proof in `folder` for the request. no_proof_needed where its plan plants no faults;
// proof_in_the_way where the folder is `out` or lies below it; another_build (program, worker and
// generator digests); weak_proof where not every fault that is planted was found by that run
// itself, or where it gave a fault fewer cases or seeds than the plan asks for; and the problems of
// read_findings.
//
// REQUIRES that no code of a plug-in ran in this process's workers before: what it could write to
// is then read already.
Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request);

}  // namespace assay::properties
