// When two features first come within a distance, in integers (geometry/near_regions.h).
#pragma once

#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::detector {

// The first time within d, if there is one. Exact for every finite input and every finite d >= 0. 3
// us if the features are within d at t=0, else some 100 us; up to 0.1 s where the exponents of
// coordinates and d spread over all doubles.
std::optional<TimeEnclosure> exact_near_time(const FourPoints& query, double d);

// The same for features that are farther apart than d from t=0 to lo and nearer than d at hi. Only
// [lo,hi] is looked at if that is enough; `guess` is about the first time. 15 us for a short piece.
TimeEnclosure exact_near_time_between(const FourPoints& query, double d, double lo, double hi,
                                      double guess);

}  // namespace assay::detector
