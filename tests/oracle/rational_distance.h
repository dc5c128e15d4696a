// Brute force for questions of distance: squared distances at rational times, in rationals, by the
// textbook cases of points, segments and triangles.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "detector/mesh/step_types.h"

namespace assay::oracle::test {

using RationalPoint = std::array<mpq_class, 3>;

inline RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline mpq_class dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline RationalPoint place_at(const detector::MovingPoint& p, const mpq_class& t) {
  RationalPoint x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = (1 - t) * mpq_class(p.t0[k]) + t * mpq_class(p.t1[k]);
  return x;
}

inline mpq_class squared_to_segment(const RationalPoint& p, const RationalPoint& a,
                                    const RationalPoint& b) {
  const RationalPoint ab = minus(b, a), ap = minus(p, a);
  const mpq_class along = dot(ap, ab), length = dot(ab, ab);
  if (along <= 0) return dot(ap, ap);
  if (along >= length) return dot(minus(p, b), minus(p, b));
  const RationalPoint area = cross(ap, ab);
  return dot(area, area) / length;
}

inline mpq_class squared_vertex_face(const RationalPoint& p, const RationalPoint& a,
                                     const RationalPoint& b, const RationalPoint& c) {
  const mpq_class least = std::min(
      {squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)});
  const RationalPoint n = cross(minus(b, a), minus(c, a));
  if (dot(n, n) == 0) return least;
  const auto inside = [&](const RationalPoint& x, const RationalPoint& y) {
    return dot(cross(minus(y, x), minus(p, x)), n) >= 0;
  };
  if (!inside(a, b) || !inside(b, c) || !inside(c, a)) return least;
  const mpq_class height = dot(minus(p, a), n);
  return std::min(least, mpq_class(height * height / dot(n, n)));
}

// Where both feet of the common perpendicular are within the edges it is the distance: each foot
// is where one edge crosses the plane through the other and the perpendicular.
inline mpq_class squared_edge_edge(const RationalPoint& a, const RationalPoint& b,
                                   const RationalPoint& c, const RationalPoint& e) {
  const mpq_class least =
      std::min(std::min(squared_to_segment(a, c, e), squared_to_segment(b, c, e)),
               std::min(squared_to_segment(c, a, b), squared_to_segment(e, a, b)));
  const RationalPoint u = minus(b, a), v = minus(e, c), w = minus(c, a), n = cross(u, v);
  if (dot(n, n) == 0) return least;
  const mpq_class s = dot(cross(w, v), n) / dot(n, n), t = dot(cross(w, u), n) / dot(n, n);
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  const mpq_class gap = dot(w, n);
  return std::min(least, mpq_class(gap * gap / dot(n, n)));
}

inline mpq_class squared_distance(const detector::FourPoints& q, const mpq_class& t) {
  std::array<RationalPoint, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = place_at(q.points[i], t);
  return q.first_group == 1 ? squared_vertex_face(x[0], x[1], x[2], x[3])
                            : squared_edge_edge(x[0], x[1], x[2], x[3]);
}

}  // namespace assay::oracle::test
