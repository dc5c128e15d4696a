// Relations between pairs for random cases: which pairs count (detector/mesh/counted_pairs.h).
#pragma once

#include "properties/generators/draft.h"
#include "properties/random.h"

namespace assay::properties {

// Gives the case a relation that leaves something out: bodies, which are its components, of which
// some do not meet; one or two rings; a distance at rest of the order of an edge, at rest as in the
// first frame. It is one of triangles or of features.
void add_relation(Random& random, GeneratedCase& made);

}  // namespace assay::properties
