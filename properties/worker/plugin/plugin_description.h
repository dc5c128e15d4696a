// What a plug-in says of itself.
#pragma once

#include <string>

#include "properties/worker/claims.h"

namespace assay::properties {

// What a library holds; the built-in detector holds steps.
struct PluginParts {
  bool steps = true, query = false, candidates = false;
  friend bool operator==(const PluginParts&, const PluginParts&) = default;
};

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
  PluginParts parts = {};
};

}  // namespace assay::properties
