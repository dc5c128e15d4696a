#include "oracle/distance/regions.h"

#include <cassert>
#include <utility>

namespace assay::oracle {

namespace {

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

IntegerPolynomial square(const PolynomialVector& v) { return dot(v, v); }

}  // namespace

Regions::Regions(const detector::FourPoints& q, const Separation& d) : first_group_(q.first_group) {
  assert(d.first >= 0 && d.second >= -d.first);
  const detector::Point distances = {d.first, d.second, 0};
  const auto& p = q.points;
  const std::array with_distances = {p[0], p[1], p[2], p[3],
                                     detector::MovingPoint{distances, distances}};
  const IntegerScale scale(with_distances);
  for (int j = 1; j < 4; ++j) x_[j] = moving_difference(scale, p[0], p[j]);
  const Integer sum = scale(d.first) + scale(d.second);
  if (sum != 0) squared_.c = {sum * sum};
}

Region Regions::points(int p, int a) const { return {square(x_[p] - x_[a]) - squared_, {}}; }

Region Regions::point_edge(int p, int a, int b) const {
  const PolynomialVector e = x_[b] - x_[a], w = x_[p] - x_[a];
  const IntegerPolynomial length = square(e), foot = dot(w, e);
  return {square(cross(w, e)) - squared_ * length, {foot, length - foot}, length};
}

Region Regions::point_face() const {
  const PolynomialVector ab = x_[2] - x_[1], ac = x_[3] - x_[1], ap = x_[0] - x_[1];
  const PolynomialVector normal = cross(ab, ac);
  const IntegerPolynomial area = square(normal), height = dot(ap, normal);
  // The sides of the foot at ab and ca; the three add up to the area.
  const IntegerPolynomial at_ab = dot(normal, cross(ab, ap)), at_ca = dot(normal, cross(ap, ac));
  return {height * height - squared_ * area, {at_ab, at_ca, area - at_ab - at_ca}, area};
}

Region Regions::edges() const {
  const PolynomialVector u = x_[1] - x_[0], v = x_[3] - x_[2], w = x_[2] - x_[0];
  const PolynomialVector normal = cross(u, v);
  const IntegerPolynomial area = square(normal), height = dot(w, normal);
  // With |N|^2 = area, the feet are x_0 + s/area u and x_2 + t/area v.
  const IntegerPolynomial s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
  return {height * height - squared_ * area, {s, area - s, t, area - t}, area};
}

Region Regions::operator[](int i) const {
  assert(i >= 0 && i < size());
  if (first_group_ == 1) {
    constexpr int face = 6;
    if (i == face) return point_face();
    return i < 3 ? points(0, 1 + i) : point_edge(0, 1 + i % 3, 1 + (i + 1) % 3);
  }
  constexpr int both = 8;
  if (i == both) return edges();
  if (i < 4) return points(i / 2, 2 + i % 2);
  return i < 6 ? point_edge(i - 4, 2, 3) : point_edge(i - 4, 0, 1);
}

}  // namespace assay::oracle
