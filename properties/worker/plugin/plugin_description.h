// What a plug-in says of itself.
#pragma once

#include <string>

#include "properties/claims/claims.h"

namespace assay::properties {

// What a library can do. The defaults are those of the built-in detector, which answers steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool takes_threads = false;  // it has a function by which it is told how many threads it may use
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// Those of its claims that can be judged by playing steps. These are all that it makes, or, for a
// library that only lists the candidates of a step, those of candidates, deterministic and total
// that it makes.
Claims claims_on_steps(const PluginDescription& description);
// Those of its claims that can be judged by asking its query: all that it makes except those about
// pairs and candidates.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
