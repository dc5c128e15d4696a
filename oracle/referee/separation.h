// Rigorous separation: a hull of differences stays away from the origin on a piece of the step.
//
// Proof used: a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), and for every corner c the
// three numbers n_s.c(s), n_s.c(e) + n_e.c(s), n_e.c(e) are > 0. They are the Bernstein
// coefficients (the middle one doubled) of the quadratic n(t).c(t), which is then > 0 on all of
// [s,e]: the hull lies strictly on one side of a plane through the origin at every time of the
// piece. With n_s = n_e a constant direction, and the swept hull itself is separated.
#pragma once

#include <cstdint>

#include "oracle/referee/difference_hull.h"

namespace assay::oracle {

// near: no direction that was tried separates surely, but for one of them rounding errors leave it
// open, so that integers may yet do it.
enum class Separation : std::uint8_t { separated, near, not_found };

// On [s,e], 0 <= s < e <= 1, multiples of 2^-53. In double with error bounds; about 1 us.
Separation separated_in_double(const DoubleHull& hull, double s, double e);

// On [k/2^depth, (k+1)/2^depth], depth <= 61. In integers; tens of us. False says nothing.
bool separated_in_integers(const IntegerHull& hull, std::int64_t k, int depth);

}  // namespace assay::oracle
