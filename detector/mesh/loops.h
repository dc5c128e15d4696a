// What keeps a mesh from being a cycle: its unmatched edges, as closed walks.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::detector {

// Vertices in order; the last leads to the first. A vertex may come up more than once.
using Loop = std::vector<std::int32_t>;

// A directed edge (u,v) used k times more than (v,u) is unmatched k times. As many unmatched edges
// enter a vertex as leave it, whatever the triangles are, so they split into closed walks: a walk
// starts at the lowest unused unmatched edge and goes on with the lowest unused one as long as
// there is one. Any split would do (L12, detector/README.md); this one is the same on every
// machine. Empty for a cycle. O(N + M).
std::vector<Loop> boundary_loops(const Topology& mesh);
// The same; of no use where `pace` was stopped.
std::vector<Loop> boundary_loops(const Topology& mesh, PacedStop& pace);

}  // namespace assay::detector
