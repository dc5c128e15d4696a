// The case analysis of Ericson, Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9. Every share
// along an edge is kept in [0,1], so that no degenerate feature leads to a place outside of it.
#include "detector/distance/nearest_places.h"

namespace assay::detector {
namespace {

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }

double share(double part, double whole) {
  return whole > 0 && part > 0 ? std::min(part / whole, 1.0) : 0;
}

// The place of the face that is nearest to the origin.
Vector of_face(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a;
  const double d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + share(d1, d1 - d3) * ab;
  const double d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + share(d2, d2 - d6) * ac;
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + share(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
  const double p = std::max(of_a, 0.0), q = std::max(of_b, 0.0), r = std::max(of_c, 0.0);
  return (a + share(q, p + q + r) * ab) + share(r, p + q + r) * ac;
}

// From the edge of c and e to that of the origin and b.
Vector between_edges(const Vector& b, const Vector& c, const Vector& e) {
  const Vector v = e - c;
  const double bb = dot(b, b), vv = dot(v, v), bv = dot(b, v), cb = dot(c, b), cv = dot(c, v);
  double s = share(cb * vv - bv * cv, bb * vv - bv * bv);
  double t = bv * s - cv;
  if (t <= 0) {
    t = 0;
    s = share(cb, bb);
  } else if (t >= vv) {
    t = vv > 0 ? 1 : 0;
    s = share(cb + t * bv, bb);
  } else {
    t = share(t, vv);
  }
  return s * b - (c + t * v);
}

}  // namespace

Vector between_nearest(const SeenPoints& x, int first_group) {
  if (first_group == 2) return between_edges(x[0], x[1], x[2]);
  return -1.0 * of_face(x[0], x[1], x[2]);
}

}  // namespace assay::detector
