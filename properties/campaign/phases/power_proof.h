// Takes the proof that planted faults are found from another run of the same build. Planted faults
// prove the harness of a build, not the detector that it judges, so the run of a plug-in need not
// plant them again.
#pragma once

#include <filesystem>

#include "properties/campaign/request.h"
#include "properties/problem.h"

namespace assay::properties {

// The proof in `folder` for the request. Fails if its plan plants no faults, if the folder is `out`
// or lies below it, if the digests of program, worker or generator differ, if that run did not find
// every planted fault itself, or gave a fault fewer cases or seeds than the plan asks for, and
// where read_findings fails.
//
// REQUIRES that no code of a plug-in has run in this process's workers yet, so that whatever it
// could write to has been read before.
Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request);

}  // namespace assay::properties
