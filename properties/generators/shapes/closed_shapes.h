// Closed rest shapes of one or two pieces. Two pieces are apart, nested, one a cavity in the
// other, or joined at a vertex or an edge.
#pragma once

#include "properties/generators/shapes/simple_shapes.h"

namespace assay::properties {

// Any closed shape with about `size` triangles (4..200); tagged "shape:...". It starts without
// contact, except for a few percent of the shapes.
Draft closed_shape(Random& random, int size);

}  // namespace assay::properties
