// Bodies that lie wholly inside others, whose surfaces they do not meet.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::reports {

struct NestedBodies {
  std::int32_t inner = 0, outer = 0;
};

// Each closed body with each other body that it holds: every component of that has a winding number
// other than 0 in it, by the oracle's exact arithmetic. Two bodies of which triangles are in
// contact are left out. `body`: by vertex. O(bodies^2) boxes, and of the outer bodies 1 us a
// vertex. REQUIRES that all pairs in contact are among `pairs`.
std::vector<NestedBodies> nested_bodies(const detector::PositionsView& x,
                                        const detector::Topology& mesh,
                                        const std::vector<std::int32_t>& body,
                                        const std::vector<detector::PairContact>& pairs);

// Returns the pairs that no third body lies between. Of shells within shells each inner one has one
// pair, with the shell next around it.
std::vector<NestedBodies> innermost(const std::vector<NestedBodies>& nested);

}  // namespace assay::reports
