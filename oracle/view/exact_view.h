// View sign of a triangle by exact polynomials and the algebraic kernel. 0.2 to 0.4 ms; up to 0.1 s
// when the exponents of the coordinates spread over all doubles.
#pragma once

#include "oracle/view/interval_view.h"

namespace assay::oracle {

// The triangle has a sign over the step exactly when no vertex meets a zero of its view function
// and the three signs at t=0 agree: the view function of a vertex is continuous.
detector::ViewSign exact_view_sign(const MovingTriangle& triangle,
                                   const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
