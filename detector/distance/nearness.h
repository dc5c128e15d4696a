// The elementary test of a separation: whether two features come within d during a step, and when
// first (L16). It is a ladder of rungs like the test of a contact (contact/elementary.h): axis
// order, doubles with proved bounds, integers. These three are counted as ContactRung::axis,
// ContactRung::filter and ContactRung::unbounded.
//
// Guarantee: for every finite input and every finite d > 0 the answer is that of exact arithmetic
// on the doubles given. A distance of exactly d is within d, and t=0 and t=1 count. The first two
// rungs allocate nothing. The rung of integers allocates. It computes the first time of each query
// whose features are not within d already at t=0.
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Tests a query. 0.1 us if the features stay farther apart than d, or are within d at t=0; a first
// time after t=0 takes 30 us more.
ContactResult test_near(const FourPoints& query, double d, Want want);

// Returns the stage of a detector with the separation d.
std::shared_ptr<const ElementaryTest> make_near_test(double d);

// The rung of integers (geometry/near_regions.h). Returns the first time within d, if there is one.
// Exact for every finite input and every finite d >= 0. 3 us if the features are within d at t=0,
// else some 100 us; up to 0.1 s where the exponents of coordinates and d spread over all doubles.
std::optional<TimeEnclosure> exact_near_time(const FourPoints& query, double d);

// Returns the first time within d. REQUIRES features that are farther apart than d from t=0 to lo
// and nearer than d at hi. `guess` is about the first time. 15 us if hi - lo is so small that one
// look at [lo,hi] is enough.
TimeEnclosure exact_near_time_between(const FourPoints& query, double d, double lo, double hi,
                                      double guess);

// Finds when two features come within a distance, in doubles with proved bounds (L16).
//
// Let n be any vector. If n.(p - q) > d |n| for every corner p of the first feature and every
// corner q of the second, the features are farther apart than d. The filter uses as n the vector
// between the nearest places of the features at an instant. It proves one piece of the step after
// another, beginning at t=0:
//   With a fixed n each n.(p - q) is linear in time, so it is enough to compute it at the two ends
//   of the piece. For most pairs that stay apart, this proves the whole step as one piece.
//   If n goes linearly from n0 at one end of the piece to n1 at the other, n.(p - q) is quadratic,
//   with the Bernstein coefficients n0.w0, (n0.w1 + n1.w0) / 2, n1.w1 for w = p - q. |n| is convex,
//   so d |n| is at most the linear function that goes from d |n0| to d |n1|.
// The next instant is the time at which the distance would be d if it kept falling as it did
// between the last two instants (the secant rule), or the end of the step. If the piece up to that
// instant cannot be proved, a nearer instant is used instead: the time up to which the fixed n of
// the last instant proves the features apart.
//
// On the other hand, two places of the features that are nearer than d prove that the features are
// within d at that instant.
//
// Error bounds, in the notation of exact/bernstein.h. M bounds the size of every coordinate of the
// points relative to the first point, at t=0 and t=1. All errors and sizes in the table are to be
// multiplied by M.
//
//   quantity               | operations                             | error in u         | size
//   x0, x1                 | a difference of two doubles            | 1                  | 1
//   x at time t            | (1-t) x0 + t x1, with 1-t rounded      | 1 + 1 + 1 + 1 = 4  | 1
//   s = n.x                | three products, two sums, by |n|_1     | 4 + 3 = 7          | 1
//   s, middle              | (n0.x1 + n1.x0) / 2                    | 7 + 1 = 8          | 1
//   gap = s - s'           | by |n|_1                               | 8 + 8 + 2 = 18     | 2
//   gap, by |n|            | |n|_1 <= sqrt(3) |n|                   | 32                 |
//   edge v = x - x'        |                                        | 4 + 4 + 2 = 10     | 2
//   v times a share        | the share is a double in [0,1]         | 10 + 2 = 12        | 2
//   place on an edge       | x + share v                            | 4 + 12 + 1 = 17    | 1
//   place on a face        | that + share v                         | 17 + 12 + 1 = 30   | 1
//     its shares           | their sum is at most 1 + 4 u           | + 4 * 2 = 38       |
//   between two edges      | place - place (with the origin: 6)     | 17 + 6 + 2 = 25    | 1
//   length between places  | sqrt(3) times 38                       | 66                 |
//
// Lengths themselves (a dot product and a root: 2.5), their product with d and a slack (2), a sum
// and a mean (2) are off by less than 7 u of their size. gap_error and place_error are larger than
// 32 and 66, so they cover errors of second order, which the table leaves out. They also cover
// underflows, because M is at least 2^-300 (in_range).

inline constexpr double gap_error = 36 * unit_roundoff;    // times M |n|
inline constexpr double place_error = 72 * unit_roundoff;  // times M
// The factor by which a length in doubles, or its product with d, may be too small.
inline constexpr double length_slack = 1 + 8 * unit_roundoff;

struct NearResult {
  Decision decision = Decision::open;
  // Set if the decision is yes. The features are farther apart than d from t=0 to lo, and nearer
  // than d at hi. If lo and hi are both 0, the features are within d at t=0.
  double lo = 0, hi = 0;
  double time_guess = 0;  // a double near the first time within d
};

// Decides a query if doubles with proved bounds can tell. REQUIRES d >= 0. 0.1 us if the features
// stay apart or are within d at t=0, otherwise 0.5 us.
NearResult filter_near(const FourPoints& query, double d);

// The largest number of pieces that are tried. Features that need more pieces come no nearer than
// about d.
inline constexpr int max_advances = 24;

// Finds where two features are nearest to each other at one instant, in plain doubles.
//
// The result is only a good guess. No decision depends on it, because the filter proves each piece
// with whatever vector n it is given.

// The points of a query at one instant, relative to the first of its four points.
using SeenPoints = std::array<Vector, 3>;  // of points 1, 2, 3

// Returns the vector from a place of the second feature to a place of the first feature. These two
// places are about the nearest ones. Each lies in its feature, up to place_error, even if the
// feature is degenerate. 20 ns.
Vector between_nearest(const SeenPoints& x, int first_group);

}  // namespace assay::detector
