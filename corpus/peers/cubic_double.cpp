// The textbook method, as many simulators have it: the times at which four points lie in one plane
// are the roots of a cubic (Provot 1997), found in closed form, and at each root the point has to
// lie in the triangle, or the edges have to cross, up to a tolerance. Doubles throughout.
//
// Version: 1, of this file. Settings: one tolerance of 1e-6, of barycentric numbers and of times.
// Contract: no contact at the start, coordinates of usual sizes, times within the tolerance.
// Claims: free-sound and not-late, since Bridson, Fedkiw and Anderson, Robust treatment of
// collisions, contact and friction for cloth animation (2002), section 6.1, offer the same test
// ("we check for interference at the roots") as one that finds all collisions of a step; total and
// deterministic, for it is a function of its arguments. All of it is a promise of the book's, made
// without a word on rounding.
#include <cmath>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

constexpr double tolerance = 1e-6;

struct Vector {
  double x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double triple(const Vector& a, const Vector& b, const Vector& c) { return dot(a, cross(b, c)); }

// The real roots of a t^3 + b t^2 + c t + d, ascending; none of a polynomial that is zero.
struct Roots {
  int count = 0;
  double at[3] = {};
  void add(double t) {
    int i = count++;
    for (; i > 0 && at[i - 1] > t; --i) at[i] = at[i - 1];
    at[i] = t;
  }
};

Roots roots_of(double a, double b, double c, double d) {
  Roots roots;
  const double scale = std::max({std::abs(a), std::abs(b), std::abs(c), std::abs(d)});
  const double small = 1e-12 * scale;
  if (std::abs(a) > small) {
    const double p = b / a, q = c / a, r = d / a;
    const double u = (p * p - 3 * q) / 9, v = (2 * p * p * p - 9 * p * q + 27 * r) / 54;
    if (v * v < u * u * u) {
      const double angle = std::acos(std::clamp(v / std::sqrt(u * u * u), -1., 1.));
      const double turn = 2 * std::acos(-1.);
      for (const double k : {0., 1., -1.})
        roots.add(-2 * std::sqrt(u) * std::cos((angle + k * turn) / 3) - p / 3);
    } else {
      const double w = -std::copysign(std::cbrt(std::abs(v) + std::sqrt(v * v - u * u * u)), v);
      roots.add(w + (w == 0 ? 0 : u / w) - p / 3);
    }
  } else if (std::abs(b) > small) {
    const double discriminant = c * c - 4 * b * d;
    if (discriminant < 0) return roots;
    const double h = -.5 * (c + std::copysign(std::sqrt(discriminant), c));
    roots.add(h / b);
    if (h != 0) roots.add(d / h);
  } else if (std::abs(c) > small) {
    roots.add(-d / c);
  }
  return roots;
}

Vector vector_of(const double* p) { return {p[0], p[1], p[2]}; }

// Where point i is at time t.
Vector place(const FourPaths& paths, int i, double t) {
  const double *p = paths.at[0][i], *q = paths.at[1][i];
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

bool is_inside(double share) { return share >= -tolerance && share <= 1 + tolerance; }

// Whether the point lies over the triangle.
bool point_meets(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = cross(b - a, c - a);
  const double area = dot(normal, normal);
  if (area == 0) return false;
  const double v = dot(cross(p - a, c - a), normal) / area;
  const double w = dot(cross(b - a, p - a), normal) / area;
  return is_inside(v) && is_inside(w) && is_inside(1 - v - w);
}

// Whether the nearest points of the two lines lie on the edges.
bool edges_meet(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector normal = cross(b - a, d - c);
  const double area = dot(normal, normal);
  if (area == 0) return false;
  const double s = dot(cross(c - a, d - c), normal) / area;
  const double t = dot(cross(c - a, b - a), normal) / area;
  return is_inside(s) && is_inside(t);
}

// The first time at which the four points lie in one plane and `meets` holds.
template <class Meets>
std::optional<plugin::Interval> first_time(const FourPaths& paths, const Meets& meets) {
  Vector x[4], v[4];  // from the first point
  for (int i = 1; i < 4; ++i) {
    x[i] = vector_of(paths.at[0][i]) - vector_of(paths.at[0][0]);
    v[i] = vector_of(paths.at[1][i]) - vector_of(paths.at[1][0]) - x[i];
  }
  const double a = triple(v[1], v[2], v[3]);
  const double b = triple(x[1], v[2], v[3]) + triple(v[1], x[2], v[3]) + triple(v[1], v[2], x[3]);
  const double c = triple(x[1], x[2], v[3]) + triple(x[1], v[2], x[3]) + triple(v[1], x[2], x[3]);
  const double d = triple(x[1], x[2], x[3]);
  const Roots roots = roots_of(a, b, c, d);
  for (int i = 0; i < roots.count; ++i) {
    if (!is_inside(roots.at[i])) continue;
    const double t = std::clamp(roots.at[i], 0., 1.);
    if (meets(place(paths, 0, t), place(paths, 1, t), place(paths, 2, t), place(paths, 3, t)))
      return plugin::Interval{{t, t}};
  }
  return std::nullopt;
}

struct CubicTests {
  static std::optional<plugin::Interval> vertex_face(const FourPaths& paths) {
    return first_time(paths, point_meets);
  }
  static std::optional<plugin::Interval> edge_edge(const FourPaths& paths) {
    return first_time(paths, edges_meet);
  }
};

struct CubicDouble : FeaturePairs<CubicTests> {
  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d;
    d.name = "cubic in doubles, tolerance 1e-6";
    d.version = "1";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_DETERMINISTIC |
               ASSAY_CLAIM_TOTAL;
    d.start = ASSAY_START_FREE;
    d.least_nonzero = 1e-6;
    d.largest = 1e6;
    d.time_tolerance = tolerance;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::CubicDouble);
