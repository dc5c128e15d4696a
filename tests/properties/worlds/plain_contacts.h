// Brute force for steps with a relation (L19): loops over all pairs of triangles and of their
// features. It decides in a plain way, independent of the detector, which pairs count.
#pragma once

#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"

namespace assay::properties::test {

// Returns the contacts of a step that count, ascending, each with its first time. With a separation
// above 0, returns the pairs that share no vertex and come within the separation. REQUIRES integer
// places at rest of at most 10, and a distance at rest that is a multiple of 1/2.
std::vector<detector::PairContact> plain_contacts(const detector::SteppedMesh& motion,
                                                  const detector::Triangles& triangles,
                                                  const detector::CountedPairs& counted,
                                                  double separation = 0);

}  // namespace assay::properties::test
