// What a plug-in says of itself.
#pragma once

#include <string>

#include "properties/claims/claims.h"

namespace assay::properties {

// What a library can do. The built-in detector has the part of steps.
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

// Those of its claims by which its steps are judged: all. For a library without steps: candidates,
// deterministic and total.
Claims claims_on_steps(const PluginDescription& description);
// Those by which its query is judged: all but those on pairs and candidates.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
