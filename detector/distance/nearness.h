// The elementary test of a separation: whether two features come within d during a step, and when
// first (L16). It is a ladder like that of a contact (contact/elementary.h): axis order, doubles
// with proved bounds, integers. The rungs of ContactRung are axis, filter and unbounded.
//
// Guarantee: for every finite input and every finite d > 0 the answer is that of exact arithmetic
// on the doubles given. A distance of exactly d is within d, and t=0 and t=1 count. The first two
// rungs allocate nothing. Integers do, and every first time after t=0 takes them.
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Tests a query. 0.1 us for a candidate that stays apart or begins near; a first time after t=0
// takes 30 us more.
ContactResult test_near(const FourPoints& query, double d, Want want);

// Returns the stage of the detector.
std::shared_ptr<const ElementaryTest> make_near_test(double d);

// The rung of integers (geometry/near_regions.h). Returns the first time within d, if there is one.
// Exact for every finite input and every finite d >= 0. 3 us if the features are within d at t=0,
// else some 100 us; up to 0.1 s where the exponents of coordinates and d spread over all doubles.
std::optional<TimeEnclosure> exact_near_time(const FourPoints& query, double d);

// Does the same for features that are farther apart than d from t=0 to lo and nearer than d at hi.
// Only [lo,hi] is looked at if that is enough; `guess` is about the first time. 15 us for a short
// piece.
TimeEnclosure exact_near_time_between(const FourPoints& query, double d, double lo, double hi,
                                      double guess);

// Finds when two features come within a distance, in doubles with proved bounds (L16).
//
// Let n be any vector. If n.(p - q) > d |n| for every corner p of the first feature and q of the
// second one, the two are farther apart than d. The filter takes for n the vector between the
// nearest places at an instant. It proves pieces of the step from the left:
//   With a fixed n each n.(p - q) is linear in time, so it is enough to look at both ends. Most
//   pairs that stay apart are proved so in one piece.
//   If n goes linearly from its vector at one instant to that at another, n.(p - q) is quadratic,
//   with the Bernstein coefficients n0.w0, (n0.w1 + n1.w0) / 2, n1.w1 for w = p - q. |n| is convex,
//   so d |n| is below the linear function with the end values d |n0| and d |n1|.
// The next instant is where the distance would come to d if it fell as it did between the last two
// (the secant rule), or the end of the step. If the piece up to that instant cannot be proved, the
// next instant is nearer: the one up to which the fixed n of this instant keeps the features apart.
//
// On the other hand, two places of the features that are nearer than d prove that the features are
// within d at that instant.
//
// Error bounds, in the notation of exact/bernstein.h. M bounds the size of every coordinate of the
// points as they are seen from the first one, at t=0 and t=1. Everything is multiplied by M.
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
// 32 and 66, so they cover errors of second order, which the rows leave out. Underflows are far
// below: M is at least 2^-300 (in_range).

inline constexpr double gap_error = 36 * unit_roundoff;    // times M |n|
inline constexpr double place_error = 72 * unit_roundoff;  // times M
// The factor by which a length in doubles, or its product with d, may be too small.
inline constexpr double length_slack = 1 + 8 * unit_roundoff;

struct NearResult {
  Decision decision = Decision::open;
  // Set if the decision is yes. The features are farther apart than d from t=0 to lo, and nearer
  // than d at hi. If lo and hi are both 0, they are within d at t=0.
  double lo = 0, hi = 0;
  double time_guess = 0;  // a double near the first time within d
};

// REQUIRES d >= 0. 0.1 us for a pair that stays apart or begins near; 0.5 us else.
NearResult filter_near(const FourPoints& query, double d);

// The greatest number of pieces. Features that need more come no nearer than about d.
inline constexpr int max_advances = 24;

// Where two features are nearest to each other at one instant, in plain doubles.
//
// This is a good guess, and no decision rests on it: the filter proves what it takes from here.

// The four points of a query at one instant, as they are seen from the first point.
using SeenPoints = std::array<Vector, 3>;  // of points 1, 2, 3

// Returns the vector from a place of the second feature to a place of the first one. The two places
// are about nearest to each other. Each lies in its feature, up to place_error, even if the feature
// is degenerate. 20 ns.
Vector between_nearest(const SeenPoints& x, int first_group);

}  // namespace assay::detector
