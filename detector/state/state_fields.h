// What a SavedState (detector.h) holds.
#pragma once

#include "detector/boundary/apex.h"
#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/state/step_state.h"
#include "detector/view/view_anchor.h"

namespace assay::detector {

struct StateFields {
  std::uint64_t mesh = 0;  // digest of the triangles and the number of vertices
  Culling culling = Culling::view_point;
  std::optional<StepState> committed;  // nothing: the next step is a new start
  // Rules and anchors are chosen from the positions that the detector was made from. They belong
  // to the state because an apex must not jump between steps (cases D7, D9).
  std::vector<ApexRule> apex_rules;
  std::vector<ViewAnchor> anchors;
};

// The digest of a mesh: equal for equal triangles in the same order and equal vertex counts. O(M).
std::uint64_t digest_of(const Topology& mesh, std::int32_t vertex_count);

// Whether all sizes and indices of the state fit a detector of this surface that has so many
// anchors of its own. REQUIRES as many apex rules as that detector has. What the state says of its
// triangles is not checked. O(M).
bool fits(const StateFields& state, const Surface& surface, std::size_t anchors);

}  // namespace assay::detector
