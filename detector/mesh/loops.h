// The unmatched edges of a mesh as closed walks. A mesh without unmatched edges is a cycle and has
// no such walks.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::detector {

// The vertices of a closed walk in order; the last edge leads from the last vertex to the first. A
// vertex may occur more than once.
using Loop = std::vector<std::int32_t>;

// Splits the unmatched edges into closed walks; there are none for a cycle. If the triangles use
// the directed edge (u,v) k times more often than (v,u), it is unmatched k times. Whatever the
// triangles are, as many unmatched edges enter a vertex as leave it, so a split into closed walks
// exists. Any split would do (L12, detector/README.md). The one made here is the same on every
// machine: a walk starts with the lowest unused unmatched edge, and from each vertex it takes the
// lowest unused one that leaves it, until none is left there. O(N + M).
std::vector<Loop> boundary_loops(const Topology& mesh);
// The same with a pace. If `pace` was stopped the result is of no use.
std::vector<Loop> boundary_loops(const Topology& mesh, PacedStop& pace);

}  // namespace assay::detector
