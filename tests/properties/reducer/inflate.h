// Large failing cases from small ones: the reverse of a reduction.
#pragma once

#include "properties/reducer/reducer.h"

namespace assay::properties::toys {

// Splits faces and edges of `small`, adds noise to every place, and puts gentle steps before and
// behind it, keeping only what fails with the same signature. Throws when `small` holds.
corpus::Case inflated_case(const corpus::Case& small, const Judge& judge, int triangles, int steps,
                           std::uint64_t seed);

}  // namespace assay::properties::toys
