// A second method for one vertex-face or edge-edge query, independent of any polynomial of the
// distance: do the two features come within d of each other during the step, and when first?
//
// Guarantee: yes and no are proved, by other means than zeros of polynomials in time: no region of
// a feature has a polynomial of its own here. open means that neither proof was found, which is
// usual when the least distance is exactly d, at a time that is not dyadic, and rare otherwise.
//   no:  [0,1] is cut into pieces, and on each of them some direction keeps the two hulls further
//        apart than d (apart, below);
//   yes: the nearest points at a rational time are within d of each other (near, below), or
//        the features meet (existence.h).
// Coordinates must be finite, and the sum of the distance finite and at least 0. Cost: 2 us if a
// direction separates over the whole step, tens of us for a first time, up to 20 ms for open.
// Thread safe. Ends the process when the processor does not round to nearest or flushes denormals.
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"
#include "oracle/rational_time.h"
#include "oracle/referee/existence.h"

namespace assay::oracle {

struct DistanceRefereeOptions {
  // The step is halved this often at most, 0 to 60.
  int depth = 60;
  // The bracket of a first time is halved until it is no longer than twice 2^-bits, bits from 0 to
  // 60. Shorter brackets find more wrong times, and where the distance only touches d they need
  // integers.
  int bits = 40;
  // The most pieces of the step that are looked at. A piece that needs integers counts as 8 or
  // more, by the length of its numbers.
  std::uint64_t max_cells = 2000;
};

struct DistanceVerdict {
  detector::Decision within = detector::Decision::open;
  // The features are farther apart than d at all times up to and including `after`. A yes has its
  // first time in (after, by]; only if `by` is 0, its first time is 0. With an open verdict,
  // features that come within d do so later than `after`.
  RationalTime after{0, 1}, by{1, 1};
  std::uint64_t cells = 0;  // the pieces of the step that were looked at
};

DistanceVerdict distance_referee(const detector::FourPoints& query, const detector::Separation& d,
                                 const DistanceRefereeOptions& options = {});

// The distance referee's two proofs: that the hull of differences comes within d of the origin at
// a time, and that it stays further away than d on a piece of the step.
//
// near:  the nearest point of the hull at rest has a length of at most d.
// apart: a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), for which n(t).c(t) > d |n(t)|
//        holds for every corner c and every t in [s,e]. Then the whole hull lies beyond the plane
//        at the distance d across n(t), so no point of it is within d. Its left side is a quadratic
//        with the Bernstein coefficients n_s.c(s), (n_s.c(e) + n_e.c(s))/2 and n_e.c(e). The right
//        side is at most linear, because a norm is convex: its coefficients of the same degree are
//        at most d |n_s|, d (|n_s| + |n_e|)/2 and d |n_e|. So three comparisons a corner are a
//        proof. The directions may be anything; those towards the nearest points at s and e lose
//        only a part that falls with the square of the piece's length.

// The difference hull in doubles, with d in its unit: least <= d <= most.
struct DoubleReach {
  DoubleHull hull;
  double least = 0, most = 0;
};

// The same in integers.
struct IntegerReach {
  IntegerHull hull;
  mpz_class d;

  std::size_t bits() const;  // of the longest number
};

DoubleReach double_reach(const detector::FourPoints& query, const detector::Separation& d);
IntegerReach integer_reach(const detector::FourPoints& query, const detector::Separation& d);

// Returns whether the hull is within d at t: yes is proved. no says that the hull, as doubles see
// it, is further away than d by more than `slack` (in the hull's unit); it is no proof.
// REQUIRES a usable hull and t in [0,1], a multiple of 2^-53. 0.2 us.
detector::Decision near_in_double(const DoubleReach& reach, double t, double slack);

// Returns whether the hull is within d at time p/q. Exact, for degenerate hulls too. 5 us.
bool near_in_integers(const IntegerReach& reach, const Fraction& time);

// Looks for a proof on [s,e]. REQUIRES 0 <= s < e <= 1, both multiples of 2^-52. 0.3 to 0.6 us.
SeparationProof apart_in_double(const DoubleReach& reach, double s, double e);

// Looks for a proof on [k/2^depth, (k+1)/2^depth]. REQUIRES depth <= 61. False says nothing. 10 to
// 60 us.
bool apart_in_integers(const IntegerReach& reach, std::int64_t k, int depth);

}  // namespace assay::oracle
