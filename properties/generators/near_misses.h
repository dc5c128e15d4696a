// Makes meshes that are nearly degenerate: ulp neighbours, slivers, vertices that all but meet.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Does one or two of these: neighbouring doubles; a vertex within 2^-20 to 2^-45 of another
// vertex, or of an edge or a face that does not hold it, in one frame or in all. Tagged
// "menu:...".
void miss_nearly(Random& random, Draft& draft);

}  // namespace assay::properties
