// View primitives of a case: none (the detector's own), points and segments, anywhere.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Sets q0, q1 for all frames; tags "view:...". A third of the cases gets none.
void choose_view(Random& random, Draft& draft);

// For meshes that are positive from `drift`, which has a place for each frame. The view is none, a
// point there, or a short segment about it.
void choose_inner_view(Random& random, Draft& draft, const Points& drift);

}  // namespace assay::properties
