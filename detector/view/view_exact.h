// The view test in exact integers: decides what the filter leaves open.
#pragma once

#include "detector/view/view_filter.h"

namespace assay::detector {

// Exact sign over the whole step (L1, L2) for every finite input; the middle piece of a view-line
// whose ends move apart is a quintic. 10 to 100 us; 1 ms, rarely 20, where denormals stand beside
// ordinary numbers.
ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

}  // namespace assay::detector
