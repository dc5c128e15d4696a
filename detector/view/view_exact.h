// The view test in exact integers. It decides what the filter leaves open.
#pragma once

#include "detector/view/view_filter.h"

namespace assay::detector {

// The exact sign over the whole step (L1, L2), for every finite input. The middle piece of a
// view-line whose ends move apart is a quintic. 10 to 100 us; if denormals stand beside ordinary
// numbers 1 ms, rarely 20 ms.
ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

}  // namespace assay::detector
