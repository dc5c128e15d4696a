// The polynomials of one query (four_points.h says what they are), with integer coefficients.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oracle/query/four_points.h"
#include "oracle/query/integer_scale.h"

namespace assay::oracle {

// Makes F and the L when they are first asked for, and keeps them. One object belongs to one query
// in one thread.
class ContactPolynomials {
 public:
  explicit ContactPolynomials(const FourPoints& q);

  // F, which is zero when the four points are coplanar.
  const IntegerPolynomial& coplanarity();
  // L_0..L_3, of the points projected along this axis.
  const std::array<IntegerPolynomial, 4>& sides(int axis);
  // All D of this axis.
  std::vector<IntegerPolynomial> gaps(int axis) const;

 private:
  const PolynomialVector& normal(int i);  // u_{i+1} x u_{i+2}, indices cyclic in 1..3

  int first_group_;
  std::array<PolynomialVector, 3> u_;
  std::array<std::optional<PolynomialVector>, 3> normals_;
  std::optional<IntegerPolynomial> coplanarity_;
  std::array<std::optional<std::array<IntegerPolynomial, 4>>, 3> sides_;
};

}  // namespace assay::oracle
