// What a plug-in says of itself.
#pragma once

#include <string>

#include "properties/worker/claims.h"

namespace assay::properties {

struct PluginDescription {
  std::string name, version;
  Claims claims;
  Contract contract;
};

}  // namespace assay::properties
