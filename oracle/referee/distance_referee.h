// Decides by a second method, for one vertex-face or edge-edge query, whether the two features come
// within d of each other during the step, and when they first do. It uses no polynomial of the
// distance.
//
// Guarantee: `yes` and `no` are proved, and not by zeros of polynomials in time, which Regions
// (distance/feature_distance.h) uses. `open` means that neither proof was found. This is usual if
// the least distance is exactly d at a time that is not dyadic, and rare otherwise.
//   no:  [0,1] is cut into pieces, and on each piece some direction keeps the two hulls further
//        apart than d (apart, below);
//   yes: the nearest points at a rational time are within d of each other (near, below), or
//        the features meet (existence.h).
// Coordinates must be finite, and the sum of d's two doubles must be finite and >= 0. Cost: 2 us if
// one direction separates over the whole step, tens of us for a first time, up to 20 ms for `open`.
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
  // 60. Shorter brackets expose more wrong times of the method under test. If the least distance is
  // d, they need integers.
  int bits = 40;
  // The greatest number of pieces of the step that are looked at. A piece that needs integers
  // counts as 8 pieces or more; the number grows with the length of its integers.
  std::uint64_t max_cells = 2000;
};

struct DistanceVerdict {
  detector::Decision within = detector::Decision::open;
  // If `within` is yes, the first time within d lies in (after, by], or is 0 if `by` is 0.
  // Otherwise the features are farther apart than d at all times up to and including `after`.
  RationalTime after{0, 1}, by{1, 1};
  std::uint64_t cells = 0;  // the pieces of the step that were looked at
};

DistanceVerdict distance_referee(const detector::FourPoints& query, const detector::Separation& d,
                                 const DistanceRefereeOptions& options = {});

// The distance referee's two proofs: that the hull of differences is within d of the origin at one
// time, and that the hull stays further away than d on a piece of the step.
//
// near:  the nearest point of the hull at rest has a length of at most d.
// apart: a direction n(t) = (1-w) n_s + w n_e, w = (t - s)/(e - s), for which n(t).c(t) > d |n(t)|
//        holds for every corner c and every t in [s,e]. Then the whole hull lies beyond the plane
//        at the distance d across n(t), so no point of the hull is within d. The left side of the
//        inequality is a quadratic with the Bernstein coefficients n_s.c(s),
//        (n_s.c(e) + n_e.c(s))/2 and n_e.c(e). A norm is convex, so the right side is at most the
//        linear function with the same values at s and e. Written as a quadratic, that function
//        has the coefficients d |n_s|, d (|n_s| + |n_e|)/2 and d |n_e|. So three comparisons a
//        corner are a proof. Any directions n_s and n_e are allowed. With the directions to the
//        nearest points at s and e, the proof loses only a distance that falls with the square of
//        the piece's length.

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

// Returns whether the hull is within d at t. `yes` is proved. `no` is not proved: it says that the
// hull as computed in doubles is further away than d by more than `slack` (in the hull's unit).
// REQUIRES a usable hull and t in [0,1], a multiple of 2^-53. 0.2 us.
detector::Decision near_in_double(const DoubleReach& reach, double t, double slack);

// Returns whether the hull is within d at time p/q. Exact, for degenerate hulls too. 5 us.
bool near_in_integers(const IntegerReach& reach, const Fraction& time);

// Looks for a proof `apart` on [s,e]. REQUIRES 0 <= s < e <= 1, both multiples of 2^-52. Takes 0.3
// to 0.6 us.
SeparationProof apart_in_double(const DoubleReach& reach, double s, double e);

// Looks for a proof `apart` on [k/2^depth, (k+1)/2^depth]. REQUIRES depth <= 61. False says
// nothing. Takes 10 to 60 us.
bool apart_in_integers(const IntegerReach& reach, std::int64_t k, int depth);

}  // namespace assay::oracle
