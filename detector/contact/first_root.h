// Encloses in doubles the first root of a cubic whose coefficients are known only up to a bound.
#pragma once

#include "detector/bernstein/bernstein.h"

namespace assay::detector {

// f holds the Bernstein coefficients over [lo,hi], each off by at most `bound`. REQUIRES that lo
// and hi are dyadic times of at most 32 bits, and that the cubic has different signs, beyond the
// bound, at the two ends. The result holds the first root: no root is before it, and one is in it
// or at its end. 0.1 us; 1 us if roots are close together.
TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi);

}  // namespace assay::detector
