// Multiple roots taken out of a polynomial, before its roots are told apart.
#pragma once

#include "detector/exact/polynomial.h"

namespace assay::detector {

// Of the same distinct roots (complex ones too), each simple; up to a non-zero constant. f must not
// be zero. 1 us where there is nothing to take out.
Polynomial square_free_part(const Polynomial& f);

}  // namespace assay::detector
