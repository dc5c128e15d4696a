// Names the triangles of a pair by their bodies, where a case has bodies.
#pragma once

#include <string>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/types.h"

namespace assay::properties {

// " (triangle 3 of body 0 and triangle 1 of body 2)", each by its number among those of its body;
// empty if there is no relation, or one without bodies. O(triangles).
std::string bodies_text(const detector::CountedPairs* counted,
                        const detector::TrianglesView& triangles,
                        const detector::TrianglePair& pair);

}  // namespace assay::properties
