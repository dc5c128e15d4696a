// The state at the start of a step: known from the last commit, or found without history.
#pragma once

#include "detector/options.h"
#include "detector/search/bounding_volume_tree.h"
#include "detector/state/step_state.h"

namespace assay::detector {

// L5 at an instant: all triangles of a closed component positive and winding number 1 at its
// primitive. Then the component is embedded and clean, whatever came before.
bool released_by_view(const Topology& mesh, const Component& component, const PositionsView& x,
                      const Point& q0, const Point& q1);

// L9 for the components listed, each a cycle: static contacts within each, then layers by piece;
// writes clean[t] of their triangles. The tree is refitted to x. False when `stop` ended it.
bool verify_start(const Topology& mesh, BoundingVolumeTree& tree, const PositionsView& x,
                  const std::vector<std::int32_t>& components, const StopFunction& stop,
                  std::vector<std::uint8_t>& clean);

}  // namespace assay::detector
