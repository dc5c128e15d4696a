// View sign of a triangle by exact polynomials and the algebraic kernel. 20 us to 3 ms.
#pragma once

#include "oracle/interval_view.h"

namespace assay::oracle {

// The triangle has a sign over the step exactly when no vertex meets a zero of its view function
// and the three signs at t=0 agree: the view function of a vertex is continuous.
detector::ViewSign exact_view_sign(const MovingTriangle& triangle,
                                   const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
