// Encloses in doubles the first root of a cubic whose coefficients are known only up to a bound.
#pragma once

#include "detector/bernstein/bernstein.h"

namespace assay::detector {

// f holds the Bernstein coefficients over [lo,hi], each off by at most `bound`. REQUIRES that lo
// and hi are k / 2^n with n <= 32, and that the cubic has different signs, beyond the bound, at
// the two ends. For each cubic that f may stand for, the closed interval of the result holds its
// first root in [lo,hi]: it begins at a time up to which there is surely no root, and ends at one
// by which the sign has surely changed. How far apart these are is not promised. 0.1 us; 1 us if
// roots are close together.
TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi);

}  // namespace assay::detector
