#include "reports/picture/contact_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace assay::reports {
namespace {

using Vector = Eigen::Vector3d;

// The middle of the closest points of the segments a0 a1 and b0 b1 (the ends are clamped one after
// the other, as in Ericson, Real-Time Collision Detection, 5.1.9).
Vector between_segments(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const Vector a = a1 - a0, b = b1 - b0, gap = a0 - b0;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ag = a.dot(gap), bg = b.dot(gap), determinant = aa * bb - ab * ab;
  const auto share = [](double part, double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  double s = share(ab * bg - ag * bb, determinant);
  const double u = share(ab * s + bg, bb);
  s = share(ab * u - ag, aa);
  return 0.5 * (a0 + s * a + b0 + u * b);
}

// Where the line e0 e1 crosses the plane of f, within the edge; its middle when it is parallel.
Vector on_plane(const Vector& e0, const Vector& e1, const std::array<Vector, 3>& f) {
  const Vector normal = (f[1] - f[0]).cross(f[2] - f[0]);
  const double h0 = normal.dot(e0 - f[0]), h1 = normal.dot(e1 - f[0]);
  const double part = h0 == h1 ? 0.5 : std::clamp(h0 / (h0 - h1), 0.0, 1.0);
  return e0 + part * (e1 - e0);
}

}  // namespace

std::optional<detector::Point> contact_point(const detector::PairContact& contact,
                                             const detector::TrianglesView& triangles,
                                             const detector::PositionsView& x_t0,
                                             const detector::PositionsView& x_t1, double t) {
  const auto place = [&](std::int32_t vertex) -> Vector {
    return (1 - t) * x_t0.row(vertex).transpose() + t * x_t1.row(vertex).transpose();
  };
  const auto& v = contact.feature.vertices;
  Vector at;
  if (contact.feature.kind == detector::FeatureKind::same_vertices) {
    const auto row = triangles.row(contact.pair.a);
    at = (place(row[0]) + place(row[1]) + place(row[2])) / 3;
  } else if (v[0] < 0) {
    return std::nullopt;
  } else if (contact.feature.kind == detector::FeatureKind::vertex_face) {
    at = place(v[0]);
  } else if (contact.feature.kind == detector::FeatureKind::edge_edge) {
    at = between_segments(place(v[0]), place(v[1]), place(v[2]), place(v[3]));
  } else {
    at = on_plane(place(v[0]), place(v[1]), {place(v[2]), place(v[3]), place(v[4])});
  }
  if (!at.allFinite()) return std::nullopt;
  return detector::Point{at[0], at[1], at[2]};
}

}  // namespace assay::reports
