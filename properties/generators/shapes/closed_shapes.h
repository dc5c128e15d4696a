// Closed rest shapes of one or two pieces: apart, nested, a cavity, at a vertex or an edge.
#pragma once

#include "properties/generators/shapes/simple_shapes.h"

namespace assay::properties {

// Any closed shape with about `size` triangles (4..200); tagged "shape:...". Starts without
// contact, but for a few percent.
Draft closed_shape(Random& random, int size);

}  // namespace assay::properties
