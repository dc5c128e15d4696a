// What a store's trials are of: the text, a JSON object, that binds a store to a run.
#pragma once

#include <optional>
#include <string>

#include "properties/campaign/runner.h"

namespace assay::properties {

// Schema `assay-store/1`: `campaign` (the plan, its times set to 0: a run that ran out of time may
// go on), `seed`, `shard`, `detector` (name, built_in, claims, contract, configurations with their
// claims), `digests` (SHA-256 of program, worker and plug-in; null for the built-in detector).
std::string binding_of(const CampaignRequest& request);

// "1/4"
std::string text_of(const Shard& shard);

// The shard of a file that holds several, and of the checks that belong to no shard.
inline constexpr const char* merged_shard = "merged";
inline constexpr const char* checks_shard = "checks";

// The same binding, of another shard; nothing for a text that is no binding.
std::optional<std::string> with_shard(const std::string& binding, const std::string& shard);

// Where two bindings differ, their shards left out: "seed 1 and 2"; empty: nowhere.
std::string difference_of(const std::string& a, const std::string& b);

}  // namespace assay::properties
