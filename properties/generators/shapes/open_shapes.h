// Unclosed rest shapes: closed ones with holes, sheets, tubes, spirals.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Any unclosed shape with about `size` triangles (2..200); tagged "shape:..." and "holes:N". Never
// a cycle.
Draft open_shape(Random& random, int size);

// A star shape with 1 to 4 small holes whose fans from the loop's mean are positive from the
// origin, as the triangles are.
Draft open_star_shape(Random& random, int size);

}  // namespace assay::properties
