// Rungs 0 and 1 of the elementary test: comparisons of inputs, then doubles with proved bounds.
// Neither ever decides wrongly; what they cannot tell is `unsure`. No allocation.
#pragma once

#include "detector/contact/contact_pieces.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Rung 0. The two groups are strictly ordered along an axis in the same sense at t=0 and at t=1:
// no contact, as every point moves linearly. Exact: compares inputs only. About 10 ns.
bool separated_along_an_axis(const FourPoints& query);

struct FilterResult {
  Decision decision = Decision::open;
  // With contact, a time wanted: whether the first contact time is known to be the only root of the
  // coplanarity cubic in (lo, hi), with a sign change of the cubic that is certain.
  bool time_bracketed = false;
  double lo = 0, hi = 1;
  double time_guess = 0;  // a double near that root
};

// Rung 1. Bernstein coefficients over pieces of [0,1] in time order. 0.1 to 1.5 us.
FilterResult filter_contact(const FourPoints& query, Want want);

// Integers cost about as much as the pieces of two more levels (contact_fixed.h).
inline constexpr int max_filter_depth = 2;

}  // namespace assay::detector
