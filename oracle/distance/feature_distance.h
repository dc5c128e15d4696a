// Finds when two moving features first come within a distance of each other, and how near they
// come.
//
// Guarantee: as in query/contact.h, the answer is that of exact arithmetic on the input doubles,
// for every finite input, degenerate features and features at rest included. Within d means at a
// distance of d or less, so within 0 means in contact. The step includes t=0 and t=1, and the
// square of d is exact. Cost: 0.03 us if an axis separates the two features; 0.3 to 0.6 us for
// nearly all other queries that are never within d, or are within d at t=0; 50 to 100 us if the
// first time is later than 0; some 0.3 ms if the least distance is exactly d. If the exponents of
// the coordinates spread over all doubles, a query takes 10 ms in the mean and up to 0.1 s. Thread
// safe. Ends the process when the processor does not round to nearest or flushes denormals.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/contact.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

using detector::Separation;

// Returns whether the two features of a query come within d (`contact` of the answer), and the
// first time at which they do. The features are a vertex and a face, or two edges, as in contact.h.
// The rung of the answer is `Rung::axis`, `Rung::interval` or, if integers decide (class Regions),
// `Rung::quadratic`. If `Rung::interval` decides that the features come within d, integers compute
// the time.
ContactAnswer first_time_within(const detector::FourPoints& q, const Separation& d,
                                detector::Want want = detector::Want::first_time);

// Returns the least double d such that the features come within d during the step. So the least
// distance is at most d and greater than the double before d; if d is 0, the least distance is 0.
// Returns infinity if every double is less than the least distance. Takes 1 ms; 25 ms if the least
// distance is close to 0 and not 0.
double least_distance(const detector::FourPoints& q);

// The nearest places of two features at one time, in plain doubles: a guess on which no verdict
// rests.

// Vertex-face: place p is the vertex, and place q on the face b is b0 + first (b1 - b0) + second
// (b2 - b0). Edge-edge: p is a0 + first (a1 - a0), and q is b0 + second (b1 - b0). Both `first` and
// `second` lie in [0,1]; for a face, so does their sum.
struct ClosestPlaces {
  double first = 0, second = 0;
  detector::Point apart{};  // from q to p
  double squared = 0;       // the square of the distance
};

ClosestPlaces closest_places(const detector::FourPoints& q, double t);

// Two features are within d of each other if they are within d in one of several regions. There is
// one region for each pair of a closed face of the first feature and a closed face of the second:
// point and point, point and edge, point and face, edge and edge.
//
// In each region one polynomial f of time compares the squared distance between the points, lines
// or planes of the two faces with d^2, without a division. Conditions g >= 0 say that the feet of
// the perpendicular lie in the faces. A strict condition says that the line or plane is not
// degenerate; it is needed because f is also zero where an edge or a normal N is zero. The features
// are within d at t exactly when, in some region, f <= 0 and all conditions hold at t. Where the
// strict condition fails, the nearest places lie on faces of lower dimension, which have regions of
// their own.
//
// So the first time within d is the least of these times of all regions:
//   0, if f <= 0 and the conditions hold at t=0;
//   the zeros of f in [0,1] at which the conditions hold, if f is not identically zero.
// Proof: let tau > 0 be the first time within d, and take a region of least dimension among the
// regions that are within d at tau. Before tau the features are farther apart than d, so the
// distance at tau is d, and f(tau) = 0. If f were identically zero, a condition would fail just
// before tau, so some g would be zero at tau. Then the foot would lie on a face of lower dimension,
// and the region would not be of least dimension. A region of two points has no conditions; if its
// f were identically zero, the features would be within d at t=0, and tau would be 0.

struct Region {
  IntegerPolynomial f;                          // within d only where f <= 0
  std::vector<IntegerPolynomial> not_negative;  // g >= 0
  IntegerPolynomial positive{{1}};              // the strict condition
};

// Makes the regions of one query, one by one. All polynomials have integer coefficients in one
// unit, and d is an integer in the same unit, so d^2 is exact.
class Regions {
 public:
  Regions(const detector::FourPoints& q, const Separation& d);

  // Returns the number of regions. Vertex-face: 3 points, 3 edges and the face. Edge-edge: 4 pairs
  // of end points, 4 pairs of an end point and an edge, and the pair of edges.
  int size() const { return first_group_ == 1 ? 7 : 9; }
  Region operator[](int i) const;

 private:
  Region points(int p, int a) const;
  Region point_edge(int p, int a, int b) const;
  Region point_face() const;
  Region edges() const;

  int first_group_;
  std::array<PolynomialVector, 4> x_;  // each point minus the first point
  IntegerPolynomial squared_;          // d^2
};

// The times of a region, exactly.

// Returns whether f <= 0 and all conditions hold at t=0.
bool near_at_start(const Region& region);

// Returns the first zero of f in (s,e] at which the conditions hold; nothing if there is none, or
// if f is identically zero. Zeros of even order are found, too. REQUIRES 0 <= s < e <= 1. Takes 1
// to 3 us if the signs of a few coefficients decide, 50 to 200 us if not.
std::optional<detector::TimeEnclosure> first_zero(const Region& region, double s, double e);

}  // namespace assay::oracle
