// Brute force in plain doubles, compiled with the flags that forget what a double is, and all
// claims made: what many a detector is. It rounds, it takes no care of motion in a plane, and the
// library switches denormal numbers off for the thread that loads it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "detector/plugin/assay_detector.h"

namespace {

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

}  // namespace

struct assay_handle {
  std::vector<std::array<std::int32_t, 3>> triangles;
  const double *x_t0, *x_t1;
  std::vector<std::int32_t> pairs;
  std::vector<double> times;

  Path path(std::int32_t v) const {
    Path p;
    for (std::size_t k = 0; k < 3; ++k) {
      p.from[k] = x_t0[3 * v + static_cast<int>(k)];
      p.to[k] = x_t1[3 * v + static_cast<int>(k)];
    }
    return p;
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
      for (std::size_t j = 0; j < 3; ++j) {
        note({p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]}, edges_cross);
      }
    }
    return first;
  }
};

namespace {

const assay_description* describe() {
  static const assay_description description = [] {
    assay_description d = {};
    d.name = "brute force, fast math";
    d.version = "1";
    d.claims = (ASSAY_CLAIM_TOTAL << 1) - 1;
    return d;
  }();
  return &description;
}

std::int32_t create(const std::int32_t* triangles, std::uint64_t m, const double*, std::uint64_t,
                    assay_handle** handle, const char**) {
  *handle = new assay_handle{};
  for (std::uint64_t t = 0; t < m; ++t) {
    (*handle)->triangles.push_back({triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]});
  }
  return ASSAY_OK;
}

std::int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  h->x_t0 = x_t0;
  h->x_t1 = x_t1;
  h->pairs.clear();
  h->times.clear();
  for (std::size_t a = 0; a < h->triangles.size(); ++a) {
    for (std::size_t b = a + 1; b < h->triangles.size(); ++b) {
      const double t = h->first_contact(a, b);
      if (t > 1) continue;
      h->pairs.insert(h->pairs.end(), {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
      h->times.insert(h->times.end(), {t, t});
    }
  }
  return ASSAY_OK;
}

std::int32_t commit(assay_handle*) { return ASSAY_OK; }

std::int32_t result(assay_handle* h, assay_result* out) {
  out->answer = h->pairs.empty() ? ASSAY_FREE : ASSAY_COLLISION;
  if (!h->times.empty()) {
    out->first_lo = out->first_hi = *std::min_element(h->times.begin(), h->times.end());
  }
  out->pair_count = h->pairs.size() / 2;
  out->pairs = h->pairs.data();
  out->pair_times = h->times.data();
  return ASSAY_OK;
}

void destroy(assay_handle* h) { delete h; }

}  // namespace

const assay_detector_api* assay_detector() {
  static const assay_detector_api api = [] {
    assay_detector_api table = {};
    table.abi_version = ASSAY_DETECTOR_ABI_VERSION;
    table.describe = describe;
    table.create = create;
    table.evaluate = evaluate;
    table.commit = commit;
    table.result = result;
    table.destroy = destroy;
    return table;
  }();
  return &api;
}
