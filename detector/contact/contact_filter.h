// Rungs 0 and 1 of the elementary test: comparisons of inputs, then doubles with proved bounds.
// Neither ever decides wrongly; what they cannot tell is `unsure`. No allocation.
#pragma once

#include "detector/contact/four_points.h"

namespace assay::detector {

// Rung 0. The two groups are strictly ordered along an axis in the same sense at t=0 and at t=1:
// no contact, as every point moves linearly. Exact: compares inputs only. About 10 ns.
bool separated_along_an_axis(const FourPoints& query);

enum class FilterVerdict : std::uint8_t { no_contact, contact, unsure };

struct FilterResult {
  FilterVerdict verdict = FilterVerdict::unsure;
  // With contact: whether the first contact time is known to be the only root of the coplanarity
  // cubic in (lo, hi), with a sign change of the cubic that is certain.
  bool time_bracketed = false;
  double lo = 0, hi = 1;
  double time_guess = 0;  // a double near that root
};

// Rung 1. Bernstein coefficients over pieces of [0,1] in time order. 0.1 to 1.5 us.
FilterResult filter_contact(const FourPoints& query);

// Derived in contact_filter.cpp; u = 2^-53, M_k = largest |coordinate k of x_j(0) - x_0(0),
// x_j(1) - x_0(1)|. After `depth` halvings a computed coefficient of the cubic is off by less than
// cubic_error(depth) * MxMyMz, one of a barycentric quadratic by quadratic_error(depth) * MpMq.
inline constexpr double unit_roundoff = 0x1p-53;
inline constexpr int max_filter_depth = 4;
constexpr double cubic_error(int depth) { return (66 + 18 * depth) * unit_roundoff; }
constexpr double quadratic_error(int depth) { return (41 + 12 * depth) * unit_roundoff; }

// The bounds hold for M_k = 0 and for M_k in this open range: products neither overflow nor lose
// more to underflow than the bounds allow (an underflow costs at most 2^-1074 an operation, the
// least bound is 2^-53 * 2^-900).
inline constexpr double least_magnitude = 0x1p-300;
inline constexpr double greatest_magnitude = 0x1p300;

}  // namespace assay::detector
