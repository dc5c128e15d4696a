// Exact view signs of triangles over a step, for view-point and view-line (L1 and L2,
// detector/README.md).
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// positive: (x - n(x)).N > 0 at every point x of the triangle and every t in [0,1], where n(x) is
// the primitive's point nearest to x and N the triangle's normal; negative: < 0; zero: neither.
// The primitive may be a point, a fixed segment, or a segment whose ends move apart (the middle
// piece is then a quintic).
detector::ViewSign view_sign(const std::array<detector::MovingPoint, 3>& triangle,
                             const detector::ViewPrimitive& primitive);

// REQUIRES one primitive for all triangles, or one for each.
std::vector<detector::ViewSign> view_signs(const detector::SteppedMesh& motion,
                                           const detector::TrianglesView& triangles,
                                           std::span<const detector::ViewPrimitive> primitives,
                                           int jobs);

}  // namespace assay::oracle
