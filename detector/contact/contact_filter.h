// Rungs 0 and 1 of the elementary test: comparisons of inputs, then doubles with proved bounds.
// Neither ever decides wrongly; what they cannot tell is `unsure`. No allocation.
#pragma once

#include "detector/bernstein/bernstein.h"
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

// Derived in contact_filter.cpp; M_k = largest |coordinate k of x_j(0) - x_0(0), x_j(1) - x_0(1)|,
// all 0 or within least_magnitude and greatest_magnitude (else the query is `unsure`). After
// `depth` halvings a computed coefficient of the cubic is off by less than cubic_error(depth) *
// MxMyMz, one of a barycentric quadratic by less than quadratic_error(depth) * MpMq.
inline constexpr int max_filter_depth = 4;
constexpr double cubic_error(int depth) { return (67 + 18 * depth) * unit_roundoff; }
constexpr double quadratic_error(int depth) { return (41 + 12 * depth) * unit_roundoff; }

}  // namespace assay::detector
