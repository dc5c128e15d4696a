// The first root of a cubic of which only an approximation is known, as an interval of doubles.
#pragma once

#include "detector/bernstein/bernstein.h"

namespace assay::detector {

// f: coefficients over [lo,hi], dyadic times of at most 32 bits, each off by at most `bound`, with
// different signs beyond that bound at the two ends. The interval holds the first root: none is
// before it, one is in it or at its end. 0.1 us; 1 us where roots are close together.
TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi);

}  // namespace assay::detector
