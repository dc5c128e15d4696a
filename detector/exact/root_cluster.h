// Roots that share one gap between adjacent doubles, told apart.
#pragma once

#include "detector/exact/root_isolation.h"

namespace assay::detector {

// Appends the roots of f in the open gap, ascending; of `any` one at most. Returns for how many
// parts of the gap sign changes were counted: it grows with the logarithm of the number of bits
// that tell the roots apart (root_cluster.cpp), not with that number.
int isolate_in_gap(const Polynomial& f, TimeEnclosure gap, Roots wanted,
                   std::vector<IsolatedRoot>& found);

}  // namespace assay::detector
