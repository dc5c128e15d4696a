#include "properties/faults/view_polynomials.h"

#include <algorithm>

#include "properties/numbering.h"

namespace assay::properties {

using detector::Integer;
using detector::MovingTriangle;
using detector::Polynomial;

namespace {

PolynomialVector operator-(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

PolynomialVector cross(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Integer value_at_start(const Polynomial& f) { return f.is_zero() ? Integer(0) : f[0]; }

Integer value_at_end(const Polynomial& f) {
  Integer sum = 0;
  for (int power = 0; power <= f.degree(); ++power) sum += f[power];
  return sum;
}

}  // namespace

Polynomial dot(const PolynomialVector& x, const PolynomialVector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

ViewPolynomials view_polynomials(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const std::array<const MovingPoint*, 5> points = {&triangle[0], &triangle[1], &triangle[2],
                                                    &primitive.q0, &primitive.q1};
  std::array<double, 30> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      values[6 * i + k] = points[i]->t0[k];
      values[6 * i + 3 + k] = points[i]->t1[k];
    }
  }
  std::array<Integer, 30> scaled;
  detector::to_common_integers(values, scaled);
  std::array<PolynomialVector, 5> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      x[i][k] = Polynomial::linear(scaled[6 * i + k], scaled[6 * i + 3 + k]);
    }
  }
  ViewPolynomials view;
  view.to_corner = x[0] - x[3];
  view.normal = cross(x[1] - x[0], x[2] - x[0]);
  view.h0 = dot(view.to_corner, view.normal);
  view.h1 = dot(x[0] - x[4], view.normal);
  const PolynomialVector d = x[4] - x[3];
  view.length2 = dot(d, d);
  view.d_normal = dot(d, view.normal);
  for (std::size_t i = 0; i < 3; ++i) {
    view.g0[i] = dot(x[i] - x[3], d);
    view.g1[i] = dot(x[i] - x[4], d);
  }
  return view;
}

ViewSign strict_sign(const Polynomial& f) {
  if (f.is_zero() || detector::has_root_in_unit_interval(f)) return ViewSign::zero;
  return static_cast<ViewSign>(f.sign_at_zero());
}

Polynomial at_start(const Polynomial& f) { return Polynomial::constant(value_at_start(f)); }
Polynomial at_end(const Polynomial& f) { return Polynomial::constant(value_at_end(f)); }

Polynomial linear_between_ends(const Polynomial& f) {
  return Polynomial::linear(value_at_start(f), value_at_end(f));
}

PolynomialVector at_start(const PolynomialVector& x) {
  return {at_start(x[0]), at_start(x[1]), at_start(x[2])};
}

PolynomialVector linear_between_ends(const PolynomialVector& x) {
  return {linear_between_ends(x[0]), linear_between_ends(x[1]), linear_between_ends(x[2])};
}

ViewPieces pieces_of_corner(const ViewPolynomials& view, std::size_t corner) {
  return {view.h0, view.h1, view.h0 * view.length2 - view.g0[corner] * view.d_normal,
          view.g0[corner], view.g1[corner]};
}

ViewSign sign_of(const ViewPieces& p) {
  const Polynomial& at_zero = p.g0.sign_at_zero() <= 0   ? p.h0
                              : p.g1.sign_at_zero() >= 0 ? p.h1
                                                         : p.middle;
  const int sign = at_zero.sign_at_zero();
  // A zero of a piece counts if the piece is the active one there. A piece that vanishes
  // identically must not become active; the middle piece is then bounded by zeros of the others.
  const auto vanishes = [](const Polynomial& h, auto is_active, const Polynomial& region) {
    if (h.is_zero()) return region.is_zero() || detector::has_root_in_unit_interval(region);
    const auto roots = detector::roots_in_unit_interval(h);
    return std::ranges::any_of(roots, is_active);
  };
  const bool at_ends = vanishes(
                           p.h0, [&](const auto& root) { return root.sign_of(p.g0) <= 0; }, p.g0) ||
                       vanishes(
                           p.h1, [&](const auto& root) { return root.sign_of(p.g1) >= 0; }, p.g1);
  const auto between = [&](const auto& root) {
    return root.sign_of(p.g0) > 0 && root.sign_of(p.g1) < 0;
  };
  if (sign == 0 || at_ends) return ViewSign::zero;
  if (!p.middle.is_zero() && vanishes(p.middle, between, p.g0)) return ViewSign::zero;
  return static_cast<ViewSign>(sign);
}

MovingPoint still(Sample sample, const MovingPoint& point) {
  if (sample == Sample::start) return {point.t0, point.t0};
  if (sample == Sample::end) return {point.t1, point.t1};
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * point.t0[k] + 0.5 * point.t1[k];
  return {middle, middle};
}

ViewSign sign_at(Sample sample, const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(
      {still(sample, triangle[0]), still(sample, triangle[1]), still(sample, triangle[2])},
      {still(sample, primitive.q0), still(sample, primitive.q1)});
}

ViewSign common_sign(std::initializer_list<ViewSign> signs) {
  const ViewSign first = *signs.begin();
  return std::ranges::all_of(signs, [&](ViewSign s) { return s == first; }) ? first
                                                                            : ViewSign::zero;
}

bool TriangleSigns::classify(const detector::Topology& surface,
                             const detector::Component& component, const SteppedMesh& motion,
                             const ViewPrimitive& primitive, std::vector<ViewSign>& signs,
                             detector::ViewCounts& counts, detector::PacedStop&) const {
  for (const auto t : component.triangles) {
    const auto& v = surface.triangles[at(t)];
    const auto corner = [&](std::size_t i) { return motion.path(v[i]); };
    signs[at(t)] = sign({corner(0), corner(1), corner(2)}, primitive);
    ++counts.exact;
  }
  return true;
}

ViewSign right_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  detector::ViewCounts counts;
  return detector::view_sign(triangle, primitive, counts);
}

}  // namespace assay::properties
