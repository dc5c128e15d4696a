#include "oracle/query/contact_events.h"

#include <algorithm>

namespace assay::oracle {

namespace {

template <class Polynomials>
bool all_zero(const Polynomials& ps) {
  return std::all_of(ps.begin(), ps.end(), [](const IntegerPolynomial& p) { return p.is_zero(); });
}

}  // namespace

std::vector<IntegerPolynomial> event_polynomials(ContactPolynomials& polynomials) {
  if (!polynomials.coplanarity().is_zero()) return {polynomials.coplanarity()};
  const IntegerPolynomial start = linear(0, 1);  // its zero is t=0
  auto with_start = [&](const auto& ps) {
    std::vector<IntegerPolynomial> events = {start};
    for (const IntegerPolynomial& p : ps) {
      if (!p.is_zero()) events.push_back(p);
    }
    return events;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!all_zero(polynomials.sides(axis))) return with_start(polynomials.sides(axis));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto gaps = polynomials.gaps(axis); !all_zero(gaps)) return with_start(gaps);
  }
  return {start};
}

bool contact_at(ContactPolynomials& polynomials, const ExactTimes& times, int i) {
  for (int axis = 0; axis < 3; ++axis) {
    bool positive = false, negative = false;
    for (const IntegerPolynomial& side : polynomials.sides(axis)) {
      const int sign = times.sign(side, i);
      positive = positive || sign > 0;
      negative = negative || sign < 0;
    }
    if (positive && negative) return false;
    if (positive || negative) return true;
  }
  // All four points lie on one line: the groups are disjoint when they are strictly ordered on it.
  for (int axis = 0; axis < 3; ++axis) {
    bool positive = false, negative = false, equal = false;
    for (const IntegerPolynomial& gap : polynomials.gaps(axis)) {
      const int sign = times.sign(gap, i);
      positive = positive || sign > 0;
      negative = negative || sign < 0;
      equal = equal || sign == 0;
    }
    if (positive || negative) return equal || (positive && negative);
  }
  return true;
}

ExactAnswer first_contact(ContactPolynomials& polynomials, const ExactTimes& times,
                          detector::Want want) {
  for (int i = 0; i < times.size(); ++i) {
    if (!contact_at(polynomials, times, i)) continue;
    if (want == detector::Want::yes_no) return {true, {}};
    return {true, times.enclosure(i)};
  }
  return {};
}

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
