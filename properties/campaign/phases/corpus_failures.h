// What curated cases and scenes show wrong, with meshes like those of the trials that fail.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/checks.h"

namespace assay::properties {

// Into `checks`, of each signature that no trial in the stores of `out` showed the smallest mesh,
// then shrunk: at most a minute each, all in the share of the plan's time that its campaign has for
// that. `failures`: in the order of the corpus. What an earlier call stored stays. `progress` is
// called with the signature that is shrunk.
void keep_corpus_failures(const CampaignRequest& request,
                          const std::vector<StoredFailure>& failures,
                          const std::filesystem::path& out, Checks& checks,
                          const std::function<void(const std::string&)>& progress);

// What the owner's cases showed in a run, into its store: rows, and of each signature that it shows
// the smallest mesh, which is shrunk with the failures of the trials. Called again it changes
// nothing, for a store is bound to its cases.
Expected<void> keep_own_cases(Store& store, const std::vector<CorpusRow>& rows,
                              const std::vector<StoredFailure>& failures);

}  // namespace assay::properties
