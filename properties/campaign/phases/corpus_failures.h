// Keeps what curated cases and scenes show wrong, with meshes like those of the trials that fail.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/checks.h"

namespace assay::properties {

// Stores in `checks` the smallest mesh of each signature that no trial in the stores of `out`
// showed, and then shrinks it: at most a minute each, all within the share of the plan's time that
// its campaign has for shrinking. `failures` are in the order of the corpus. What an earlier call
// stored stays. `progress` is called with the signature that is being shrunk.
void keep_corpus_failures(const CampaignRequest& request,
                          const std::vector<StoredFailure>& failures,
                          const std::filesystem::path& out, Checks& checks,
                          const std::function<void(const std::string&)>& progress);

// Stores what the owner's cases showed in a run: the rows, and the smallest mesh of each
// signature, which is shrunk with the failures of the trials. A second call changes nothing,
// because a store is bound to its cases.
Expected<void> keep_own_cases(Store& store, const std::vector<CorpusRow>& rows,
                              const std::vector<StoredFailure>& failures);

}  // namespace assay::properties
