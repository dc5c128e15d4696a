// Brute force for questions of which pairs count (L19): loops over all pairs of triangles and of
// their features, with the relation decided in a plain way of its own.
#pragma once

#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"

namespace assay::properties::test {

// The contacts of a step that count, ascending, each with its first time. With a separation above 0
// these are the pairs that share no vertex and come within it. REQUIRES integer places at rest of
// at most 10 and a distance that is a multiple of a half.
std::vector<detector::PairContact> plain_contacts(const detector::SteppedMesh& motion,
                                                  const detector::Triangles& triangles,
                                                  const detector::CountedPairs& counted,
                                                  double separation = 0);

}  // namespace assay::properties::test
