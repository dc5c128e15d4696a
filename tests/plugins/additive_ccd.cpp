// An additive CCD, as many people have it: while two features are apart, time advances by an
// interval in which they cannot meet, and then their distance is measured again. It is the detector
// of reports/check/TEN_MINUTES.md, with the fault that is mended there.
#include <algorithm>
#include <array>
#include <cmath>

#include "detector/plugin/assay_detector.hpp"
using namespace assay::plugin;

struct Vec {
  double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(Vec a) { return std::sqrt(dot(a, a)); }
double share(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0., 1.) : 0; }
using Four = std::array<Vec, 4>;

// The distance of the segments p0 p1 and p2 p3.
double between_segments(const Four& p) {
  const Vec a = p[1] - p[0], b = p[3] - p[2], gap = p[0] - p[2];
  const double bb = dot(b, b), ab = dot(a, b), bg = dot(b, gap);
  const Vec n = cross(a, b);  // aa * bb - ab * ab of nearly parallel edges is rounding alone
  double s = share(dot(n, cross(b, gap)), dot(n, n));
  const double u = share(ab * s + bg, bb);
  return length(gap + s * a - u * b);
}

// The distance of the point p0 and the triangle p1 p2 p3.
double to_triangle(const Four& p) {
  double least = 1e300;
  const Vec n = cross(p[2] - p[1], p[3] - p[1]);
  bool is_inside = dot(n, n) > 0;
  for (int i = 1; i < 4; ++i) {
    const Vec from = p[i], edge = p[i % 3 + 1] - from, q = p[0] - from;
    is_inside = is_inside && dot(cross(n, edge), q) >= 0;
    least = std::min(least, length(q - share(dot(q, edge), dot(edge, edge)) * edge));
  }
  return is_inside ? std::min(least, std::abs(dot(n, p[0] - p[1])) / length(n)) : least;
}

struct AdditiveCcd {
  static Description describe() {
    Description d;
    d.name = "my CCD";
    d.version = "1.0";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_TOTAL;
    d.least_nonzero = 1e-50, d.largest = 1e50;  // squares of squares are numbers too
    return d;
  }
  static Result query(std::int32_t kind, Positions x_t0, Positions x_t1) {
    Four start, way;
    Vec mean{0, 0, 0};  // what all four have in common brings them no nearer
    for (std::size_t i = 0; i < 4; ++i) {
      start[i] = {x_t0[i][0], x_t0[i][1], x_t0[i][2]};
      way[i] = Vec{x_t1[i][0], x_t1[i][1], x_t1[i][2]} - start[i];
      mean = mean + 0.25 * way[i];
    }
    std::size_t firsts = kind == ASSAY_QUERY_VERTEX_FACE ? 1 : 2;  // points of the first feature
    double speed[2] = {0, 0}, size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      double& most = speed[i < firsts ? 0 : 1];
      most = std::max(most, length(way[i] - mean));
      size = std::max(size, length(start[i]) + length(way[i]));
    }
    const double nearly = 1e-9 * size;  // above the rounding of what follows
    double t = 0;
    for (int round = 0; round < 1000; ++round) {
      Four now;
      for (std::size_t i = 0; i < 4; ++i) now[i] = start[i] + t * way[i];
      const double apart = firsts == 1 ? to_triangle(now) : between_segments(now);
      if (apart <= nearly) return Result::collision(t, 1);
      if (speed[0] + speed[1] == 0) return Result::free();
      const double next = t + 0.9 * apart / (speed[0] + speed[1]);
      if (next > 1) return Result::free();
      t = next;
    }
    return Result::collision(t, 1);  // it may be nothing; it is safe
  }
};
ASSAY_EXPORT_DETECTOR(AdditiveCcd);
