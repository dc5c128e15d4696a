// Decides which missing pairs the contact graph at the first contact time of a step excuses.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::properties {

// Moves from `missing` to `excused` the pairs that need not be found to have the first contact
// right: pairs later than `first`, and pairs whose part of the graph holds a pair that is not
// missing. The graph has the triangles as nodes. Its edges are those pairs of `pairs` (all pairs
// of the oracle that count) whose time is `first`. Times that share an enclosure count as one
// time. O(n log n).
void excuse_beside_the_first(const std::vector<detector::PairContact>& pairs,
                             const detector::TimeEnclosure& first,
                             std::vector<detector::PairContact>& missing,
                             std::vector<detector::PairContact>& excused);

}  // namespace assay::properties
