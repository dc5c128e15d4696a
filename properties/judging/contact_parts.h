// The places of contact at one time, as parts of the contact graph.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::properties {

using ContactPart = std::vector<detector::PairContact>;

// The connected parts of the contact graph, each with its pairs. Triangles are nodes, and the
// pairs whose first time is `time` are edges. Two times that share an enclosure count as one;
// parts may then be joined, but never split. O(n log n).
std::vector<ContactPart> contact_parts(const std::vector<detector::PairContact>& pairs,
                                       const detector::TimeEnclosure& time);

}  // namespace assay::properties
