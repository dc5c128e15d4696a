// The view sign of a triangle in interval arithmetic, on pieces of the step. For a view-point it
// takes 0.2 us over a small motion and 2 us over a large one, for a segment 7 us. Its answers are
// certain.
#pragma once

#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using MovingTriangle = std::array<detector::MovingPoint, 3>;

// Empty when intervals cannot tell. Notation, with N = (p1 - p0) x (p2 - p0) and d = q1 - q0:
//   h0 = (p - q0).N, h1 = (p - q1).N (the same for every p in the triangle's plane),
//   g0 = (p - q0).d, g1 = (p - q1).d = g0 - |d|^2, hm = h1 g0 - h0 g1 = h0 |d|^2 - g0 (d.N).
// The view function of p is h0 when g0 <= 0, h1 when g1 >= 0, and hm / |d|^2 between them.
std::optional<detector::ViewSign> interval_view_sign(const MovingTriangle& triangle,
                                                     const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
