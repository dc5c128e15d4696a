#include "properties/worker/plugin/plugin_description.h"

namespace assay::properties {

Claims claims_on_steps(const PluginDescription& description) {
  const Claims& all = description.claims;
  if (description.parts.steps) return all;
  Claims kept;
  kept.deterministic = all.deterministic;
  kept.total = all.total;
  kept.candidates = all.candidates;
  return kept;
}

Claims claims_on_queries(const PluginDescription& description) {
  Claims kept = description.claims;
  kept.first_pairs = kept.all_pairs = kept.candidates = false;
  return kept;
}

}  // namespace assay::properties
