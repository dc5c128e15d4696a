#include "reports/pictures/contact_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace assay::reports {

namespace {

using Vector = Eigen::Vector3d;
using Corners = std::array<std::int32_t, 3>;

// The point where the line e0 e1 crosses the plane of f, within the edge. If it is parallel to the
// plane, the middle of the edge.
Vector on_plane(const Vector& e0, const Vector& e1, const std::array<Vector, 3>& f) {
  const Vector normal = (f[1] - f[0]).cross(f[2] - f[0]);
  const double h0 = normal.dot(e0 - f[0]), h1 = normal.dot(e1 - f[0]);
  const double part = h0 == h1 ? 0.5 : std::clamp(h0 / (h0 - h1), 0.0, 1.0);
  return e0 + part * (e1 - e0);
}

// The points where two triangles come closest, by features that share no vertex. Nothing if all of
// their features share one.
template <class Place>
std::optional<NearestPoints> where_closest(const Corners& a, const Corners& b, const Place& place) {
  std::optional<NearestPoints> best;
  const auto offer = [&](const NearestPoints& points) {
    if (!best || points.distance() < best->distance()) best = points;
  };
  const auto has = [](const Corners& corners, std::int32_t v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  for (const auto& [vertices, face] : {std::pair(a, b), std::pair(b, a)}) {
    const std::array<Vector, 3> corners = {place(face[0]), place(face[1]), place(face[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = vertices[i], to = vertices[(i + 1) % 3];
      if (has(face, from)) continue;
      offer(nearest_of_triangle(place(from), corners));
      // An edge that pierces the face.
      if (!has(face, to))
        offer(nearest_of_triangle(on_plane(place(from), place(to), corners), corners));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Corners first = {a[i], a[(i + 1) % 3], -1}, second = {b[j], b[(j + 1) % 3], -2};
      if (has(first, second[0]) || has(first, second[1])) continue;
      offer(nearest_of_segments(place(first[0]), place(first[1]), place(second[0]),
                                place(second[1])));
    }
  }
  return best;
}

}  // namespace

std::optional<NearestPoints> contact_places(const detector::PairContact& contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& x_t0,
                                            const detector::PositionsView& x_t1, double t) {
  const auto place = [&](std::int32_t vertex) -> Vector {
    return (1 - t) * x_t0.row(vertex).transpose() + t * x_t1.row(vertex).transpose();
  };
  const auto corners = [&](std::int32_t triangle) -> Corners {
    const auto row = triangles.row(triangle);
    return {row[0], row[1], row[2]};
  };
  const auto one = [](const Vector& at) { return NearestPoints{at, at}; };
  const auto& v = contact.feature.vertices;
  std::optional<NearestPoints> places;
  if (contact.feature.kind == detector::FeatureKind::same_vertices) {
    const auto f = corners(contact.pair.a);
    places = one((place(f[0]) + place(f[1]) + place(f[2])) / 3);
  } else if (v[0] < 0) {
    places = where_closest(corners(contact.pair.a), corners(contact.pair.b), place);
  } else if (contact.feature.kind == detector::FeatureKind::vertex_face) {
    places = nearest_of_triangle(place(v[0]), {place(v[1]), place(v[2]), place(v[3])});
  } else if (contact.feature.kind == detector::FeatureKind::edge_edge) {
    places = nearest_of_segments(place(v[0]), place(v[1]), place(v[2]), place(v[3]));
  } else {
    places = one(on_plane(place(v[0]), place(v[1]), {place(v[2]), place(v[3]), place(v[4])}));
  }
  return places && std::isfinite(places->distance()) ? places : std::nullopt;
}

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
