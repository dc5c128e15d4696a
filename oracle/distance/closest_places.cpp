#include "oracle/distance/closest_places.h"

#include <algorithm>

namespace assay::oracle {

namespace {

using detector::Point;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// 0 over 0 is no share at all; any will do.
double share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0;
}

// The face's place nearest to the point. Which of its faces that lies on is read off the signs of
// products (Ericson, Real-Time Collision Detection, 5.1.5).
void nearest_on_face(const Point& p, const Point& a, const Point& b, const Point& c,
                     ClosestPlaces& places) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  double &v = places.first, &w = places.second;
  if (d1 <= 0 && d2 <= 0) return;
  if (d3 >= 0 && d4 <= d3) {
    v = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    v = share(d1, d1 - d3);
  } else if (d6 >= 0 && d5 <= d6) {
    w = 1;
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    w = share(d2, d2 - d6);
  } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
    w = share(d4 - d3, (d4 - d3) + (d5 - d6));
    v = 1 - w;
  } else {
    v = share(vb, va + vb + vc);
    w = std::min(share(vc, va + vb + vc), 1 - v);
  }
}

// The two edges begin at a and c, with the directions u and v.
void nearest_on_edges(const Point& a, const Point& u, const Point& c, const Point& v,
                      ClosestPlaces& places) {
  const Point r = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  double &s = places.first, &t = places.second;
  s = share(uv * vr - ur * vv, uu * vv - uv * uv);
  t = share(uv * s + vr, vv);
  s = share(uv * t - ur, uu);
}

}  // namespace

ClosestPlaces closest_places(const detector::FourPoints& q, double t) {
  std::array<Point, 4> x{};  // seen from the first point
  for (int j = 1; j < 4; ++j) {
    for (int k = 0; k < 3; ++k) {
      x[j][k] = (1 - t) * (q.points[j].t0[k] - q.points[0].t0[k]) +
                t * (q.points[j].t1[k] - q.points[0].t1[k]);
    }
  }
  ClosestPlaces places;
  if (q.first_group == 1) {
    nearest_on_face(x[0], x[1], x[2], x[3], places);
    const Point to_b = places.first * (x[2] - x[1]), to_c = places.second * (x[3] - x[1]);
    places.apart = ((Point{} - x[1]) - to_b) - to_c;
  } else {
    const Point v = x[3] - x[2];
    nearest_on_edges(x[0], x[1], x[2], v, places);
    places.apart = (places.first * x[1] - x[2]) - places.second * v;
  }
  places.squared = dot(places.apart, places.apart);
  return places;
}

}  // namespace assay::oracle
