// Whether a segment strictly pierces a triangle at an instant, in doubles or floats alone.
#pragma once

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// With proved bounds: `no` and `yes` are never wrong, and `open` means that doubles cannot tell.
// 40 ns, no allocation.
Decision bounded_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

// As computed in Number (double or float). It promises nothing.
template <class Number>
bool plain_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

}  // namespace assay::detector
