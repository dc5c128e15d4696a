// When are two features near each other? A union over regions, one for each pair of closed faces of
// the two: point and point, point and edge, point and face, edge and edge.
//
// In each region the squared distance of the two faces' lines or planes is compared with d^2 by one
// polynomial f of time, without a division. Conditions g >= 0 say that the feet of the
// perpendicular lie in the faces. A strict condition says that the line or plane is one, for where
// an edge or a normal N is zero, f is zero, too. The features are within d at t exactly when some
// region has f <= 0 with its conditions at t: where the strict one fails, the distance is that of
// lower faces, which are regions themselves.
//
// So the first time within d is the least over the regions of
//   0, if f <= 0 with the conditions at t=0;
//   the zeros of f in [0,1] at which the conditions hold, if f is not identically zero.
// Let tau > 0 be the first time, in a region of least dimension. Nothing is near before tau, so the
// distance at tau is d, and f(tau) = 0. Were f identically zero, a condition would fail just before
// tau, so some g would be zero at tau: the foot would lie on a lower face, and the region would not
// be of least dimension. A region of two points has no conditions: it would be near at 0.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

using detector::Separation;

struct Region {
  IntegerPolynomial f;                          // near only where f <= 0
  std::vector<IntegerPolynomial> not_negative;  // g >= 0
  IntegerPolynomial positive{{1}};              // the strict condition
};

// Makes the regions of one query, one by one. All polynomials are of integers in one unit, d too,
// so d^2 is exact.
class Regions {
 public:
  Regions(const detector::FourPoints& q, const Separation& d);

  // 3 points, 3 edges and the face, or 4 pairs of points, 4 of an end and an edge, and the edges.
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

// Whether f <= 0 with all conditions at t=0.
bool near_at_start(const Region& region);

// The first zero of f in (s,e] at which the conditions hold; nothing if there is none, or if f is
// identically zero. Zeros of even order count. REQUIRES 0 <= s < e <= 1. 1 to 3 us if the signs of
// a few coefficients decide, 50 to 200 us if not.
std::optional<detector::TimeEnclosure> first_zero(const Region& region, double s, double e);

}  // namespace assay::oracle
