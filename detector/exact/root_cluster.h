// Tells apart roots that lie in one gap between adjacent doubles.
#pragma once

#include "detector/exact/root_isolation.h"

namespace assay::detector {

// Appends the roots of f in the open gap to `found`, ascending; with Roots::any, one root at most.
// Returns for how many parts of the gap sign changes were counted. That number grows with the
// logarithm of the number of bits that tell the roots apart (root_cluster.cpp), not with the
// number of bits.
int isolate_in_gap(const Polynomial& f, TimeEnclosure gap, Roots wanted,
                   std::vector<IsolatedRoot>& found);

}  // namespace assay::detector
