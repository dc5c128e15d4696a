// What curated cases and scenes show wrong, with meshes like those of the trials that fail.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"

namespace assay::reports {

// Signatures of the failures in the shards of a folder, and in its merged store.
std::set<std::string> signatures_of_trials(const std::filesystem::path& out);

// Into `checks`, of each signature that no trial showed the smallest mesh, then shrunk: at most a
// minute each, all in the share of the plan's time that its campaign has for that. `failures`: in
// the order of the corpus. What an earlier call stored stays.
void keep_corpus_failures(const properties::CampaignRequest& request,
                          const std::vector<properties::StoredFailure>& failures,
                          const std::set<std::string>& known, properties::Store& checks);

}  // namespace assay::reports
