// Closed rest shapes in one piece, about the origin, radius of the order of 1, outward normals.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// A tetrahedron, bipyramid, sphere, capsule, star or torus with about `size` triangles (4..200),
// in varied proportions; tagged "shape:...". `star_shaped` is set if all triangles are positive
// from the origin.
Draft simple_shape(Random& random, int size);

// Such a shape with `star_shaped` set: convex, or a star with small hollows.
Draft star_shape(Random& random, int size);

}  // namespace assay::properties
