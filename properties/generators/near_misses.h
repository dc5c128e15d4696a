// Beside degenerate: ulp neighbours, slivers, vertices that all but meet.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// One or two of: neighbouring doubles; a vertex within 2^-20 to 2^-45 of another, of an edge or of
// a face that does not hold it, in one frame or in all. Tagged "menu:...".
void miss_nearly(Random& random, Draft& draft);

}  // namespace assay::properties
