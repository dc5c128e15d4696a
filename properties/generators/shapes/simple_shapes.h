// Closed rest shapes in one piece, about the origin, radius of the order of 1, outward normals.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Tetrahedron, bipyramid, sphere, capsule, star or torus with about `size` triangles (4..200), in
// varied proportions; tagged "shape:...". `star_shaped` is set where all triangles are positive
// from the origin.
Draft simple_shape(Random& random, int size);

// One with `star_shaped`: convex, or a star of small hollows.
Draft star_shape(Random& random, int size);

}  // namespace assay::properties
