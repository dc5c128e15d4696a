// What a store's trials are of: the text, a JSON object, that binds a store to a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"

namespace assay::properties {

// Schema `assay-store/2`: `campaign` (the plan, its times set to nothing: a run that ran out of
// time may go on), `seed`, `shard`, `detector` (name, built_in, contract, configurations with their
// claims), `planted_faults` (how many this build has), `digests` (SHA-256 of program, worker and
// plug-in, null for the built-in detector, and of the generator's first cases).
std::string binding_of(const CampaignRequest& request);

// The same, read back.
struct BoundRun {
  struct Configuration {
    std::string name;
    std::vector<std::string> claims;
  };
  CampaignPlan plan;
  std::uint64_t seed = 0, planted_faults = 0;
  std::string shard;  // "1/4", merged_shard or checks_shard
  std::string detector;
  bool built_in = true;
  std::string adjacency, coordinates;  // the contract, by the names of claims.h
  double margin = 0;
  std::vector<Configuration> configurations;
  std::string program, worker, generator;
  std::optional<std::string> plugin;
};
// Throws StoreProblem where the text is no binding of this schema. file: named in the problem.
BoundRun read_binding(const std::string& text, const std::filesystem::path& file);

// The same binding, of another shard; nothing for a text that is no binding.
std::optional<std::string> with_shard(const std::string& binding, const std::string& shard);

// Where two bindings differ, their shards left out: "seed 1 and 2"; empty: nowhere.
std::string difference_of(const std::string& a, const std::string& b);

// SHA-256 over the first cases of every family: another generator makes other cases. About 10 ms.
std::string generator_digest();

}  // namespace assay::properties
