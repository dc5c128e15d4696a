// Rungs 0 and 1 of the elementary test: comparisons of inputs, then doubles with proved bounds.
// Neither ever decides wrongly. Queries that they cannot decide go to the next rung. No
// allocation.
#pragma once

#include "detector/contact/contact_pieces.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// The axis rung. Whether the two groups are more than `by` apart along an axis, in the same sense
// at t=0 and at t=1. Then they are so throughout, because every point moves linearly; by 0, there
// is no contact. Exact: a difference of doubles that is rounded to more than a double is more than
// it. REQUIRES by >= 0. About 10 ns.
bool separated_along_an_axis(const FourPoints& query, double by = 0);

struct FilterResult {
  Decision decision = Decision::open;
  // Set only if the decision is yes and a time is wanted. True if the first contact time is
  // known to be the only root of the coplanarity cubic in (lo, hi), and the cubic certainly
  // changes its sign there.
  bool time_bracketed = false;
  double lo = 0, hi = 1;
  double time_guess = 0;  // a double near that root
};

// The filter rung. Looks at Bernstein coefficients over pieces of [0,1] in time order. 0.1 to 1.5
// us.
FilterResult filter_contact(const FourPoints& query, Want want);

// How often pieces are halved. A halving takes 40 ns, and integers (contact_fixed.h) take 2 us. So
// where the sign of the cubic is sure at both ends of a piece, halving soon finds the part with the
// root, and the signs of the dependencies there: of 5,171 queries of a simulation it settles all
// but 37, and two levels leave 1,097 open. Where it is not sure, as at a contact just at t=0 or of
// points that stay coplanar, more halvings would mostly be in vain, and so they would be after a
// piece that stays open.
inline constexpr int max_filter_depth = 8, max_unsure_depth = 2, max_filter_halvings = 16;

}  // namespace assay::detector
