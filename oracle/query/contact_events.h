// The common part of all exact rungs: the polynomials of a query, the times at which a contact can
// begin, and whether there is a contact at such a time.
//
// Notation of this room: x_0..x_3 are the four moving points of a query, S is the first group of
// them and S' the second (vertex-face {0}|{1,2,3}, edge-edge {0,1}|{2,3}), and u_j = x_j - x_0 for
// j = 1..3.
//   F     = det(u_1, u_2, u_3), a cubic in time: zero where the four points are coplanar.
//   lam_k = the affine dependency of the four points projected along axis k, quadratics:
//           lam_1 = [u_2 x u_3]_k, lam_2 = [u_3 x u_1]_k, lam_3 = [u_1 x u_2]_k, lam_0 = -(sum).
//   L_i   = lam_i on S, -lam_i on S'.
//   D_ij  = coordinate k of x_i - x_j, i in S, j in S'.
// At a time at which F is zero, the hulls of S and S' meet exactly when some non-zero dependency is
// >= 0 on S and <= 0 on S'. Any axis whose L are not all zero decides this: the hulls meet exactly
// when all L of this axis are >= 0 or all are <= 0.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/times.h"

namespace assay::oracle {

using detector::four_points;
using detector::FourPoints;

// The polynomials of one query, with integer coefficients.
// Computes F and the L when they are first needed, and stores them. One object belongs to one query
// in one thread.
class ContactPolynomials {
 public:
  explicit ContactPolynomials(const FourPoints& q);

  // Returns F, which is zero when the four points are coplanar.
  const IntegerPolynomial& coplanarity();
  // Returns L_0..L_3 of the points projected along this axis.
  const std::array<IntegerPolynomial, 4>& sides(int axis);
  // Returns all D of this axis.
  std::vector<IntegerPolynomial> gaps(int axis) const;

 private:
  const PolynomialVector& normal(int i);  // u_{i+1} x u_{i+2}, indices cyclic in 1..3

  int first_group_;
  std::array<PolynomialVector, 3> u_;
  std::array<std::optional<PolynomialVector>, 3> normals_;
  std::optional<IntegerPolynomial> coplanarity_;
  std::array<std::optional<std::array<IntegerPolynomial, 4>>, 3> sides_;
};

// The answer of an exact rung.
struct ExactAnswer {
  bool contact = false;
  detector::TimeEnclosure first;  // set when there is a contact and a time was wanted
};

// Returns the polynomials whose zeros in [0,1] are the times at which a contact can begin; none is
// identically zero.
// - These times are the zeros of F, if F is not identically zero.
// - Else t=0 and the zeros of the L of an axis whose L are not all identically zero.
// - If all L of all axes are identically zero, t=0 and the zeros of the D of an axis whose D are
//   not all identically zero. If there is no such axis, only t=0.
// Between two neighbouring zeros, contact neither begins nor ends, and the set of contact times is
// closed. So the first of these times with a contact is the first contact time.
std::vector<IntegerPolynomial> event_polynomials(ContactPolynomials& polynomials);

// Returns whether there is a contact at the i-th time. REQUIRES that F is zero at that time.
bool contact_at(ContactPolynomials& polynomials, const ExactTimes& times, int i);

// Returns the answer, given all times at which a contact can begin.
ExactAnswer first_contact(ContactPolynomials& polynomials, const ExactTimes& times,
                          detector::Want want);

}  // namespace assay::oracle
