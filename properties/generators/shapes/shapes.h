// Rest shapes. Closed ones of one piece, and of two, which are apart, nested, one a cavity in the
// other, or joined at a vertex or an edge. Unclosed ones (closed ones with holes, sheets, tubes,
// spirals, rings with a gap that close), and damaged ones.
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

// Any unclosed shape with about `size` triangles (2..200); tagged "shape:..." and "holes:N". Never
// a cycle.
Draft open_shape(Random& random, int size);

// A star shape with 1 to 4 small holes whose fans from the loop's mean are positive from the
// origin, as the triangles are.
Draft open_star_shape(Random& random, int size);

// A mesh that a detector has to accept although few of its kind are the surface of a body: a closed
// or unclosed shape with one to three damages: triangles that are missing, turned round
// or without area, doubled vertices and open seams, 3 to 6 triangles at an edge, vertices that
// nothing uses, triangles between any vertices. Tagged "broken:...".
Draft broken_shape(Random& random, int size);

}  // namespace assay::properties
