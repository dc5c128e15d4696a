// Brute force in plain doubles, compiled with the flags that relax the rules of floating point, and
// with all claims made: many detectors are like this. It rounds, it does not handle motion in a
// plane, and its library switches denormal numbers off for the thread that loads it.
#include <algorithm>

#include "detector/plugin/assay_detector.hpp"

namespace {

using namespace assay::plugin;
using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Path {
  Vector from, to;
  Vector at(double t) const {
    Vector p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + t * (to[k] - from[k]);
    return p;
  }
};
using Four = std::array<Path, 4>;
using FourPoints = std::array<Vector, 4>;

FourPoints at(const Four& paths, double t) {
  return {paths[0].at(t), paths[1].at(t), paths[2].at(t), paths[3].at(t)};
}

double volume(const FourPoints& p) { return dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]); }

// Vertex p[0] in triangle p[1] p[2] p[3], all in one plane.
bool vertex_in_face(const FourPoints& p) {
  const Vector n = cross(p[2] - p[1], p[3] - p[1]);
  for (std::size_t i = 1; i <= 3; ++i) {
    const auto &a = p[i], &b = p[i % 3 + 1];
    if (dot(cross(b - a, p[0] - a), n) < 0) return false;
  }
  return true;
}

// Segments p[0] p[1] and p[2] p[3], all in one plane.
bool edges_cross(const FourPoints& p) {
  const Vector n = cross(p[1] - p[0], p[3] - p[2]);
  const double length = dot(n, n);
  const double s = dot(cross(p[2] - p[0], p[3] - p[2]), n) / length;
  const double u = dot(cross(p[2] - p[0], p[1] - p[0]), n) / length;
  return s >= 0 && s <= 1 && u >= 0 && u <= 1;
}

// The first sampled interval in which the volume changes sign, halved to its end.
template <class Inside>
bool first_time(const Four& paths, Inside inside, double& time) {
  constexpr int samples = 16, halvings = 60;
  for (int i = 0; i < samples; ++i) {
    double lo = double(i) / samples, hi = double(i + 1) / samples;
    const double before = volume(at(paths, lo));
    if (before * volume(at(paths, hi)) > 0) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (lo + hi) / 2;
      (before * volume(at(paths, middle)) > 0 ? lo : hi) = middle;
    }
    if (!inside(at(paths, hi))) continue;
    time = hi;
    return true;
  }
  return false;
}

struct FastMath {
  static Description describe() {
    Description d;
    d.name = "brute force, fast math";
    d.version = "1";
    d.claims = (ASSAY_CLAIM_TOTAL << 1) - 1;
    return d;
  }
  explicit FastMath(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto* corners = mesh.triangles[t];
      triangles.push_back({corners[0], corners[1], corners[2]});
    }
  }

  Result evaluate(Positions start, Positions end) {
    x_t0 = start.data();
    x_t1 = end.data();
    Result result = Result::collision(2, 2);
    for (std::size_t a = 0; a < triangles.size(); ++a) {
      for (std::size_t b = a + 1; b < triangles.size(); ++b) {
        const double t = first_contact(a, b);
        if (t > 1) continue;
        result.add(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), t, t);
        if (t < result.first[0]) result.first = {{t, t}};
      }
    }
    return result.pairs.empty() ? Result::free() : result;
  }

 private:
  std::vector<std::array<std::int32_t, 3>> triangles;
  const double *x_t0 = nullptr, *x_t1 = nullptr;

  Path path(std::int32_t v) const {
    const double *p = x_t0 + 3 * v, *q = x_t1 + 3 * v;
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2]}};
  }

  // 2 when the triangles do not meet.
  double first_contact(std::size_t a, std::size_t b) const {
    double first = 2;
    const auto note = [&](std::array<std::int32_t, 4> v, auto inside) {
      auto sorted = v;
      std::sort(sorted.begin(), sorted.end());
      if (std::unique(sorted.begin(), sorted.end()) != sorted.end()) return;
      double t;
      if (first_time({path(v[0]), path(v[1]), path(v[2]), path(v[3])}, inside, t)) {
        first = std::min(first, t);
      }
    };
    const auto &p = triangles[a], &q = triangles[b];
    for (std::size_t i = 0; i < 3; ++i) {
      note({p[i], q[0], q[1], q[2]}, vertex_in_face);
      note({q[i], p[0], p[1], p[2]}, vertex_in_face);
      for (std::size_t j = 0; j < 3; ++j)
        note({p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]}, edges_cross);
    }
    return first;
  }
};

}  // namespace

ASSAY_EXPORT_DETECTOR(FastMath);
