#include "oracle/query/contact_polynomials.h"

namespace assay::oracle {

ContactPolynomials::ContactPolynomials(const FourPoints& q) : first_group_(q.first_group) {
  const IntegerScale scale(q.points);
  for (int j = 0; j < 3; ++j) u_[j] = moving_difference(scale, q.points[0], q.points[j + 1]);
}

const PolynomialVector& ContactPolynomials::normal(int i) {
  if (!normals_[i]) normals_[i] = cross(u_[(i + 1) % 3], u_[(i + 2) % 3]);
  return *normals_[i];
}

const IntegerPolynomial& ContactPolynomials::coplanarity() {
  if (!coplanarity_) coplanarity_ = dot(u_[0], normal(0));
  return *coplanarity_;
}

const std::array<IntegerPolynomial, 4>& ContactPolynomials::sides(int axis) {
  if (!sides_[axis]) {
    const IntegerPolynomial &l1 = normal(0)[axis], &l2 = normal(1)[axis], &l3 = normal(2)[axis];
    sides_[axis] = {-(l1 + l2 + l3), first_group_ == 2 ? l1 : -l1, -l2, -l3};
  }
  return *sides_[axis];
}

std::vector<IntegerPolynomial> ContactPolynomials::gaps(int axis) const {
  std::vector<IntegerPolynomial> d;
  for (int i = 0; i < first_group_; ++i) {
    for (int j = first_group_; j < 4; ++j) {
      d.push_back(i == 0 ? -u_[j - 1][axis] : u_[i - 1][axis] - u_[j - 1][axis]);
    }
  }
  return d;
}

}  // namespace assay::oracle
