// Keeps what curated cases and scenes show wrong: each with a small mesh that shows it, as for the
// trials that fail.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/checks.h"

namespace assay::properties {

// Takes the failures whose signature no trial in the stores of `out` has, and stores in `checks`
// the smallest mesh of each such signature. Then it shrinks these meshes. That takes at most a
// minute for each, and for all together the share of the plan's time that is kept for shrinking.
// REQUIRES failures in the order of the corpus. What an earlier call stored stays. `progress` is
// called with the signature that is being shrunk.
void keep_corpus_failures(const CampaignRequest& request,
                          const std::vector<StoredFailure>& failures,
                          const std::filesystem::path& out, Checks& checks,
                          const std::function<void(const std::string&)>& progress);

// Stores what the user's own cases (`--corpus DIR`) showed in a run: the rows, and the smallest
// mesh of each signature, which is shrunk with the failures of the trials. A store belongs to one
// set of cases, so a second call finds its rows there and changes nothing.
Expected<void> keep_own_cases(Store& store, const std::vector<CorpusRow>& rows,
                              const std::vector<StoredFailure>& failures);

}  // namespace assay::properties
