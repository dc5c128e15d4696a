// The times of one region (regions.h), exactly.
#pragma once

#include <optional>

#include "oracle/distance/regions.h"

namespace assay::oracle {

// Whether f <= 0 with all conditions at t=0.
bool near_at_start(const Region& region);

// The first zero of f in (s,e] at which the conditions hold; nothing if there is none, or if f is
// identically zero. Zeros of even order count. REQUIRES 0 <= s < e <= 1. 1 to 3 us if the signs of
// a few coefficients decide, 50 to 200 us if not.
std::optional<detector::TimeEnclosure> first_zero(const Region& region, double s, double e);

}  // namespace assay::oracle
