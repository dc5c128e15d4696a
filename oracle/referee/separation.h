// Proves that a hull of differences stays away from the origin on a piece of the step.
//
// The proof is a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), for which the three
// numbers n_s.c(s), n_s.c(e) + n_e.c(s), n_e.c(e) are > 0 for every corner c. They are the
// Bernstein coefficients (the middle one doubled) of the quadratic n(t).c(t), which is then > 0 on
// all of [s,e]: the hull lies strictly on one side of a plane through the origin at every time of
// the piece. If n_s = n_e, the direction is constant, and the swept hull itself is separated.
#pragma once

#include <cstdint>

#include "oracle/referee/difference_hull.h"

namespace assay::oracle {

// near: no direction that was tried surely separates, but for one of them rounding errors leave it
// open, or a difference overflows in double. Integers may yet prove it.
enum class Separation : std::uint8_t { separated, near, not_found };

// On [s,e]. REQUIRES 0 <= s < e <= 1, both multiples of 2^-53. In double with error bounds; about
// 1 us.
Separation separated_in_double(const DoubleHull& hull, double s, double e);

// On [k/2^depth, (k+1)/2^depth]. REQUIRES depth <= 61. In integers; tens of us. False: nothing is
// known.
bool separated_in_integers(const IntegerHull& hull, std::int64_t k, int depth);

}  // namespace assay::oracle
