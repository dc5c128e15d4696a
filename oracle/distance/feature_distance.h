// Finds when two moving features first come within a distance of each other, and how near they
// come.
//
// Guarantee: as in query/contact.h, the answer is that of exact arithmetic on the doubles given,
// for every finite input, degenerate features and features at rest included. Within d means a
// distance of d or less, t=0 and t=1 count, and the square of d is exact. With d = 0 this is a
// contact. Cost: 0.03 us if an axis tells, 0.3 to 0.6 us for nearly all other pairs that stay apart
// or begin near; a first time later than 0 takes 50 to 100 us, a touch at exactly d some 0.3 ms. If
// exponents spread over all doubles, 10 ms in the mean and up to 0.1 s. Thread safe. Ends the
// process when the processor does not round to nearest or flushes denormals.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/contact.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

using detector::Separation;

// Returns whether the two features of a query come within d (`contact` of the answer), and when
// they first do. The features are a vertex and a face, or two edges, as in contact.h. The rung of
// the answer is axis, interval, or, where integers decide (Regions), quadratic. If the rung
// interval finds the features within d, integers compute the time.
ContactAnswer first_time_within(const detector::FourPoints& q, const Separation& d,
                                detector::Want want = detector::Want::first_time);

// Returns the least double d that the features come within during the step. So the least distance
// is at most d and greater than the double before d; if d is 0, it is 0. Returns infinity if no
// double is so large. 1 ms; 25 ms if the distance is next to 0 but not 0.
double least_distance(const detector::FourPoints& q);

// The nearest places of two features at one time, in plain doubles: a guess that nothing rests on.

// Vertex-face: the second place is b0 + first (b1 - b0) + second (b2 - b0) of the face b.
// Edge-edge: the places are a0 + first (a1 - a0) and b0 + second (b1 - b0). The shares are >= 0 and
// at most 1; for a face their sum is at most 1, too.
struct ClosestPlaces {
  double first = 0, second = 0;
  detector::Point apart{};  // from the second place to the first
  double squared = 0;       // the square of the distance
};

ClosestPlaces closest_places(const detector::FourPoints& q, double t);

// Two features are near each other if they are near in one of several regions. There is a region
// for each pair of closed faces of the two: point and point, point and edge, point and face, edge
// and edge.
//
// In each region the squared distance of the two faces' lines or planes is compared with d^2 by one
// polynomial f of time, without a division. Conditions g >= 0 say that the feet of the
// perpendicular lie in the faces. A strict condition says that the line or plane is not degenerate,
// because where an edge or a normal N is zero, f is zero, too. The features are within d at t
// exactly when some region has f <= 0 with its conditions at t: where the strict condition fails,
// the distance is that of lower faces, which have regions themselves.
//
// So the first time within d is the least over the regions of
//   0, if f <= 0 with the conditions at t=0;
//   the zeros of f in [0,1] at which the conditions hold, if f is not identically zero.
// Let tau > 0 be the first time, in a region of least dimension. Nothing is near before tau, so the
// distance at tau is d, and f(tau) = 0. Were f identically zero, a condition would fail just before
// tau, so some g would be zero at tau: the foot would lie on a lower face, and the region would not
// be of least dimension. A region of two points has no conditions: it would be near at 0.

struct Region {
  IntegerPolynomial f;                          // near only where f <= 0
  std::vector<IntegerPolynomial> not_negative;  // g >= 0
  IntegerPolynomial positive{{1}};              // the strict condition
};

// Makes the regions of one query, one by one. All polynomials have integers in one unit, and d is
// in that unit too, so d^2 is exact.
class Regions {
 public:
  Regions(const detector::FourPoints& q, const Separation& d);

  // Returns the number of regions: 3 points, 3 edges and the face; or 4 pairs of ends, 4 pairs of
  // an end and an edge, and the pair of edges.
  int size() const { return first_group_ == 1 ? 7 : 9; }
  Region operator[](int i) const;

 private:
  Region points(int p, int a) const;
  Region point_edge(int p, int a, int b) const;
  Region point_face() const;
  Region edges() const;

  int first_group_;
  std::array<PolynomialVector, 4> x_;  // the points, seen from the first
  IntegerPolynomial squared_;          // d^2
};

// The times of a region, exactly.

// Returns whether f <= 0 with all conditions at t=0.
bool near_at_start(const Region& region);

// Returns the first zero of f in (s,e] at which the conditions hold; nothing if there is none, or
// if f is identically zero. Zeros of even order count. REQUIRES 0 <= s < e <= 1. 1 to 3 us if the
// signs of a few coefficients decide, 50 to 200 us if not.
std::optional<detector::TimeEnclosure> first_zero(const Region& region, double s, double e);

}  // namespace assay::oracle
