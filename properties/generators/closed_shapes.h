// Closed rest shapes with outward normals, about the origin, radius of the order of 1.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Any closed shape with about `size` triangles (4..200); tagged "shape:...". Starts without
// contact, but for a few percent.
Draft closed_shape(Random& random, int size);

// One whose triangles are all positive from the origin: convex, or a star of small hollows.
Draft star_shape(Random& random, int size);

}  // namespace assay::properties
