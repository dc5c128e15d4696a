// What a plug-in says of itself.
#pragma once

#include <string>
#include <string_view>

#include "properties/claims/claims.h"

namespace assay::properties {

// What a library can do. The defaults are those of the built-in detector, which answers steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  bool limit = false;
  bool takes_threads = false;  // it has a function by which it is told how many threads it may use
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

// What keeps a text from being the name of a detector, or its version: it is longer than 100 bytes,
// begins or ends with a space, or is the name of the built-in detector. Empty if nothing does.
std::string fault_of_name(std::string_view name);

// What is wrong with what it says of a limiter: claims without one, one without claims, or a claim
// on progress without Contract::progress. Empty if nothing is.
std::string fault_of_limits(const Claims& claims, const Contract& contract, bool has_limit);

// Those of its claims that can be judged by playing steps. These are all that it makes, or, for a
// library that answers no steps, those of candidates, limits, deterministic and total.
Claims claims_on_steps(const PluginDescription& description);
// Those of its claims that can be judged by asking its query: all that it makes except those about
// pairs, candidates and limits.
Claims claims_on_queries(const PluginDescription& description);

}  // namespace assay::properties
