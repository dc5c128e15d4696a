#include "reports/pictures/nearest_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace assay::reports {

using Vector = Eigen::Vector3d;

namespace {

// part / whole, clamped to [0,1]. It is 0 if the whole has no length.
double share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
}

// The largest coordinate, as a power of two. If numbers are divided by it, no product of four of
// them overflows.
double size_of(std::initializer_list<Vector> points) {
  double largest = 0;
  for (const auto& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return largest > 0 ? std::ldexp(1.0, std::ilogb(largest)) : 1;
}

NearestPoints scaled(const NearestPoints& nearest, double size) {
  return {size * nearest.a, size * nearest.b};
}

// The parameters are clamped one after the other, as in Ericson, Real-Time Collision Detection,
// 5.1.9.
NearestPoints of_segments(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const Vector a = a1 - a0, b = b1 - b0, gap = a0 - b0;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ag = a.dot(gap), bg = b.dot(gap);
  double s = share(ab * bg - ag * bb, aa * bb - ab * ab);
  const double u = share(ab * s + bg, bb);
  s = share(ab * u - ag, aa);
  return {a0 + s * a, b0 + u * b};
}

NearestPoints of_triangle(const Vector& point, const std::array<Vector, 3>& corners) {
  const Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double area = normal.squaredNorm();
  bool inside = area > 0;
  NearestPoints best;
  double least = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& from = corners[i];
    const Vector& to = corners[(i + 1) % 3];
    inside = inside && normal.dot((to - from).cross(point - from)) >= 0;
    const NearestPoints on_edge = of_segments(point, point, from, to);
    if (i == 0 || on_edge.distance() < least) {
      best = on_edge;
      least = on_edge.distance();
    }
  }
  if (inside) best = {point, point - normal * (normal.dot(point - corners[0]) / area)};
  return best;
}

}  // namespace

NearestPoints nearest_of_segments(const Vector& a0, const Vector& a1, const Vector& b0,
                                  const Vector& b1) {
  const double size = size_of({a0, a1, b0, b1});
  return scaled(of_segments(a0 / size, a1 / size, b0 / size, b1 / size), size);
}

NearestPoints nearest_of_triangle(const Vector& point, const std::array<Vector, 3>& corners) {
  const double size = size_of({point, corners[0], corners[1], corners[2]});
  return scaled(
      of_triangle(point / size, {corners[0] / size, corners[1] / size, corners[2] / size}), size);
}

}  // namespace assay::reports
