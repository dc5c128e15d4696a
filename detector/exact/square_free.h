// Makes the multiple roots of a polynomial simple, before its roots are told apart.
#pragma once

#include "detector/exact/polynomial.h"

namespace assay::detector {

// A polynomial with the same distinct roots as f (complex ones too), each of them simple; its
// constant factor is any but 0. REQUIRES that f is not zero. 1 us if f has no multiple root.
Polynomial square_free_part(const Polynomial& f);

}  // namespace assay::detector
