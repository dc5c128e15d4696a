// What a plug-in says of itself.
#pragma once

#include <string>

#include "properties/claims/claims.h"

namespace assay::properties {

// What a library holds; the built-in detector holds steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool takes_threads = false;  // it asks how many threads it may use
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// Of its claims those that a part of it is judged by. Its steps: all; of a library without steps
// candidates, deterministic and total.
Claims claims_on_steps(const PluginDescription& description);
// Its query: all but those on pairs and candidates.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
