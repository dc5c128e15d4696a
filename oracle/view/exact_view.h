// The view sign of a triangle by exact polynomials and the algebraic kernel. 0.2 to 0.4 ms; up to
// 0.1 s when the exponents of the coordinates spread over all doubles.
#pragma once

#include "oracle/view/interval_view.h"

namespace assay::oracle {

// The triangle is positive or negative over the step exactly when the view function of no vertex
// is ever zero and the three signs at t=0 agree, because the view function of a vertex is
// continuous.
detector::ViewSign exact_view_sign(const MovingTriangle& triangle,
                                   const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
