// Closed rest shapes of one piece, and of two. Two pieces are apart, nested, one a cavity in the
// other, or joined at a vertex or an edge.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// The shapes in one piece lie about the origin, radius of the order of 1, outward normals.

// A tetrahedron, bipyramid, sphere, capsule, star or torus with about `size` triangles (4..200),
// in varied proportions; tagged "shape:...". `star_shaped` is set if all triangles are positive
// from the origin.
Draft simple_shape(Random& random, int size);

// Such a shape with `star_shaped` set: convex, or a star with small hollows.
Draft star_shape(Random& random, int size);

// Any closed shape with about `size` triangles (4..200); tagged "shape:...". It starts without
// contact, except for a few percent of the shapes.
Draft closed_shape(Random& random, int size);

}  // namespace assay::properties
