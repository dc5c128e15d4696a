// The elementary test of a separation: whether two features come within d during a step, and when
// first (L16). It is a ladder like that of a contact (contact/elementary.h): axis order, doubles
// with proved bounds, integers. The rungs of ContactRung are axis, filter and unbounded.
//
// Guarantee: for every finite input and every finite d > 0 the answer is that of exact arithmetic
// on the doubles given. A distance of exactly d is within d, and t=0 and t=1 count. The first two
// rungs allocate nothing; integers, which every first time after t=0 takes, do.
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// 0.1 us for a candidate that stays apart or begins near; a first time after t=0 costs 30 us more.
ContactResult test_near(const FourPoints& query, double d, Want want);

// The stage of the detector.
std::shared_ptr<const ElementaryTest> make_near_test(double d);

// The rung of integers (geometry/near_regions.h): the first time within d, if there is one. Exact
// for every finite input and every finite d >= 0. 3 us if the features are within d at t=0, else
// some 100 us; up to 0.1 s where the exponents of coordinates and d spread over all doubles.
std::optional<TimeEnclosure> exact_near_time(const FourPoints& query, double d);

// The same for features that are farther apart than d from t=0 to lo and nearer than d at hi. Only
// [lo,hi] is looked at if that is enough; `guess` is about the first time. 15 us for a short piece.
TimeEnclosure exact_near_time_between(const FourPoints& query, double d, double lo, double hi,
                                      double guess);

}  // namespace assay::detector
