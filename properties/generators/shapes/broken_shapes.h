// Meshes that a detector has to accept although few of them are the surface of a body.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// A closed or unclosed shape with one to three damages: triangles that are missing, turned round
// or without area, doubled vertices and open seams, 3 to 6 triangles at an edge, vertices that
// nothing uses, triangles between any vertices. Tagged "broken:...".
Draft broken_shape(Random& random, int size);

}  // namespace assay::properties
