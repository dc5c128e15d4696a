// Squared distances of two moving features at a rational time, by the textbook cases of points,
// segments and triangles. This code shares nothing with the regions of the detector, with which it
// is compared.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include "detector/mesh/step_types.h"

namespace assay::tests {

using Rational = boost::multiprecision::cpp_rational;
using RationalPoint = std::array<Rational, 3>;

inline RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Rational dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline RationalPoint place_at(const detector::MovingPoint& p, const Rational& t) {
  RationalPoint x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = (1 - t) * Rational(p.t0[k]) + t * Rational(p.t1[k]);
  return x;
}

inline Rational squared_to_segment(const RationalPoint& p, const RationalPoint& a,
                                   const RationalPoint& b) {
  const RationalPoint e = minus(b, a);
  const Rational along = dot(minus(p, a), e), length = dot(e, e);
  const Rational share = along <= 0 ? Rational(0) : along >= length ? Rational(1) : along / length;
  RationalPoint foot;
  for (std::size_t k = 0; k < 3; ++k) foot[k] = length == 0 ? a[k] : Rational(a[k] + share * e[k]);
  return dot(minus(p, foot), minus(p, foot));
}

// Inside the prism over the triangle, the distance is the height; elsewhere it is that of the
// nearest edge.
inline Rational squared_to_triangle(const RationalPoint& p, const RationalPoint& a,
                                    const RationalPoint& b, const RationalPoint& c) {
  const Rational least =
      std::min(std::min(squared_to_segment(p, a, b), squared_to_segment(p, b, c)),
               squared_to_segment(p, c, a));
  const RationalPoint n = cross(minus(b, a), minus(c, a));
  const Rational area = dot(n, n);
  if (area == 0) return least;
  const Rational of_c = dot(cross(minus(b, a), minus(p, a)), n) / area,
                 of_a = dot(cross(minus(c, b), minus(p, b)), n) / area;
  if (of_a < 0 || of_c < 0 || of_a + of_c > 1) return least;
  const Rational height = dot(minus(p, a), n);
  return std::min(least, Rational(height * height / area));
}

// Two edges that are not parallel are nearest at the feet of their common perpendicular (Cramer's
// rule), or at an end of an edge.
inline Rational squared_between_segments(const RationalPoint& a, const RationalPoint& b,
                                         const RationalPoint& c, const RationalPoint& e) {
  const Rational least =
      std::min(std::min(squared_to_segment(a, c, e), squared_to_segment(b, c, e)),
               std::min(squared_to_segment(c, a, b), squared_to_segment(e, a, b)));
  const RationalPoint u = minus(b, a), v = minus(e, c), r = minus(a, c);
  const Rational uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), ur = dot(u, r), vr = dot(v, r);
  const Rational determinant = uu * vv - uv * uv;
  if (determinant == 0) return least;
  const Rational s = (uv * vr - vv * ur) / determinant, t = (uu * vr - uv * ur) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  RationalPoint between;
  for (std::size_t k = 0; k < 3; ++k) between[k] = r[k] + s * u[k] - t * v[k];
  return std::min(least, dot(between, between));
}

inline Rational squared_distance(const detector::FourPoints& q, const Rational& t) {
  std::array<RationalPoint, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = place_at(q.points[i], t);
  return q.first_group == 1 ? squared_to_triangle(x[0], x[1], x[2], x[3])
                            : squared_between_segments(x[0], x[1], x[2], x[3]);
}

inline Rational squared(double d) { return Rational(d) * Rational(d); }

}  // namespace assay::tests
