// The view test in doubles with proved bounds. It certifies most signs, and none wrongly.
#pragma once

#include <array>
#include <optional>

#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Corners in the triangle's order.
using MovingTriangle = std::array<MovingPoint, 3>;

// The sign over the whole step (L1, L2), or nothing if doubles cannot tell. `zero` is certified
// too: it means that two values of strictly different sign were found. 20 to 500 ns, no
// allocation.
std::optional<ViewSign> filter_view_sign(const MovingTriangle& triangle,
                                         const ViewPrimitive& primitive);

// The same with bounds 0, as computed in Number (double or float). It promises nothing. A sign
// that stays open is zero.
template <class Number>
ViewSign plain_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

// Error bounds after `depth` halvings, derived in view_filter.cpp, in units of 2^-53 times the
// scales named there.
template <class Bounds = ProvedBounds>
constexpr auto view_cubic_error(int depth) {
  return static_cast<typename Bounds::Number>(24 + 6 * depth) * Bounds::unit;
}
template <class Bounds = ProvedBounds>
constexpr auto view_axial_error(int depth) {
  return static_cast<typename Bounds::Number>(8 + 2 * depth) * Bounds::unit;
}
inline constexpr int max_view_depth = 5;

}  // namespace assay::detector
