// Bounds, with u = 2^-53. Places are scaled by a power of two, so that the largest coordinate M of
// both triangles, at t=0 and at t=1, is in [0.5, 1). If M is below 2^-1001 before scaling, it is
// only multiplied by 2^1000, and stays below 0.5.
// - A place at t, (1 - t) x0 + t x1, is off by at most 4 u. A sum of three weighted places is off
//   by at most 8 u, and the computed difference between that sum and `point` by at most 10 u.
//   `error` is the computed difference plus 16 u. It does not depend on how `point` was computed.
// - An edge vector at t is computed from the edge vectors at t=0 and t=1, whose coordinates are at
//   most D; it is off by at most 5 u D. With E for a second edge, the cross product N of two edges
//   is off by at most 26 u D E in each coordinate, so its direction is off by at most 2 sqrt(3) 26
//   u D E / |N|. Dividing by the length adds 4 u, which is at most 12 u D E / |N|. The sum is less
//   than 128 u D E / |N|.
#include "detector/contact_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "detector/parallel/workers.h"

namespace assay::detector {

namespace {

using Vector3 = Eigen::Vector3d;
using Weights = std::array<double, 3>;  // of the vertices of a feature

constexpr double place_error = 0x1p-49;    // 16 u
constexpr double product_error = 0x1p-46;  // 128 u

// The weights of the vertices of two features, and the squared distance of the two places that they
// give.
struct Nearest {
  Weights a{}, b{};
  double squared = std::numeric_limits<double>::infinity();
};

double share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0;
}

void keep_nearer(Nearest& best, const Nearest& other) {
  if (other.squared < best.squared) best = other;
}

Nearest of_edges_from(double s, const Vector3& a0, const Vector3& u, const Vector3& b0,
                      const Vector3& v) {
  const double t = share(v.dot(a0 + s * u - b0), v.squaredNorm());
  s = share(u.dot(b0 + t * v - a0), u.squaredNorm());
  return {{1 - s, s, 0}, {1 - t, t, 0}, (a0 + s * u - b0 - t * v).squaredNorm()};
}

// Finds the nearest places. If the edges are nearly parallel, a start at an end of one is better
// than the quotient.
Nearest nearest_of_edges(const Vector3& a0, const Vector3& a1, const Vector3& b0,
                         const Vector3& b1) {
  const Vector3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double s = share(uv * v.dot(w) - u.dot(w) * vv, uu * vv - uv * uv);
  Nearest best = of_edges_from(s, a0, u, b0, v);
  for (const double start : {0.0, 1.0, share(u.dot(b0 - a0), uu), share(u.dot(b1 - a0), uu)})
    keep_nearer(best, of_edges_from(start, a0, u, b0, v));
  return best;
}

Nearest nearest_of_face(const Vector3& p, const std::array<Vector3, 3>& f) {
  Nearest best;
  const Vector3 normal = (f[1] - f[0]).cross(f[2] - f[0]);
  Weights inside{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &from = f[(i + 1) % 3], &to = f[(i + 2) % 3];
    inside[i] = std::max(0.0, normal.dot((to - from).cross(p - from)));
    sum += inside[i];
  }
  if (sum > 0) {
    for (double& weight : inside) weight /= sum;
    const Vector3 place = inside[0] * f[0] + inside[1] * f[1] + inside[2] * f[2];
    best = {{1, 0, 0}, inside, (p - place).squaredNorm()};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto on_edge = of_edges_from(0, p, Vector3::Zero(), f[i], f[j] - f[i]);
    Nearest nearest = {{1, 0, 0}, {}, on_edge.squared};
    nearest.b[i] = on_edge.b[0];
    nearest.b[j] = on_edge.b[1];
    keep_nearer(best, nearest);
  }
  return best;
}

// The vertices of two triangles, scaled, at one time.
class Places {
 public:
  Places(const SteppedMesh& motion, const TrianglesView& triangles, const PairContact& contact)
      : motion_(motion), t_(contact.time.lo) {
    double largest = 0;
    for (const auto triangle : {contact.pair.a, contact.pair.b}) {
      for (int corner = 0; corner < 3; ++corner) {
        const auto v = triangles(triangle, corner);
        largest = std::max({largest, motion.vertices_t0.row(v).cwiseAbs().maxCoeff(),
                            motion.vertices_t1.row(v).cwiseAbs().maxCoeff()});
      }
    }
    if (largest > 0) exponent_ = std::max(std::ilogb(largest) + 1, least_exponent);
    scale_ = std::ldexp(1, -exponent_);
  }

  int exponent() const { return exponent_; }
  Vector3 at(std::int32_t v) const {
    return (1 - t_) * scaled(motion_.start(v)) + t_ * scaled(motion_.end(v));
  }

  struct Edge {
    Vector3 at_t;
    double size;  // its largest coordinate at either end
  };
  Edge edge(std::int32_t from, std::int32_t to) const {
    const Vector3 start = scaled(motion_.start(to)) - scaled(motion_.start(from)),
                  end = scaled(motion_.end(to)) - scaled(motion_.end(from));
    return {(1 - t_) * start + t_ * end,
            std::max(start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff())};
  }

 private:
  // Returns the scaled point. Exact, except for results below the normal numbers.
  Vector3 scaled(const Point& x) const { return {scale_ * x[0], scale_ * x[1], scale_ * x[2]}; }

  static constexpr int least_exponent = -1000;  // 2^1000 is a double, and 2^1074 is none

  const SteppedMesh& motion_;
  const double t_;
  int exponent_ = 0;
  double scale_ = 1;  // 2^-exponent_
};

void set_normal(const Places::Edge& u, const Places::Edge& v, ContactPlace& place) {
  const Vector3 normal = u.at_t.cross(v.at_t);
  const double length = normal.norm();
  place.normal_error = product_error * u.size * v.size / length;
  // Roundings below the normal numbers are far smaller than this.
  constexpr double surely_normal = 0x1p-900;
  if (!(length > surely_normal && place.normal_error < 0.5)) {
    place.normal_error = 0;
    return;
  }
  place.normal = {normal[0] / length, normal[1] / length, normal[2] / length};
}

}  // namespace

ContactPlace contact_place(const SteppedMesh& motion, const TrianglesView& triangles,
                           const PairContact& contact) {
  const ProcessorState state;
  auto [kind, named] = contact.feature;
  // Triangles with the same vertices meet at each of them; this takes the first.
  if (kind == FeatureKind::same_vertices) {
    kind = FeatureKind::vertex_face;
    named = {named[0], named[0], named[1], named[2], -1};
  }
  const auto& v = named;
  const Places places(motion, triangles, contact);
  const auto face = [&](std::size_t first) {
    return std::array{places.at(v[first]), places.at(v[first + 1]), places.at(v[first + 2])};
  };
  ContactPlace place;
  Nearest nearest;
  std::size_t of_a = 1, count = 4;  // vertices of the first feature, and of both
  if (kind == FeatureKind::vertex_face) {
    nearest = nearest_of_face(places.at(v[0]), face(1));
    set_normal(places.edge(v[1], v[2]), places.edge(v[1], v[3]), place);
  } else if (kind == FeatureKind::edge_edge) {
    of_a = 2;
    nearest = nearest_of_edges(places.at(v[0]), places.at(v[1]), places.at(v[2]), places.at(v[3]));
    set_normal(places.edge(v[0], v[1]), places.edge(v[2], v[3]), place);
  } else {
    of_a = 2;
    count = 5;
    const auto f = face(2);
    const Vector3 e0 = places.at(v[0]), e1 = places.at(v[1]),
                  normal = (f[1] - f[0]).cross(f[2] - f[0]);
    const double above = std::abs(normal.dot(e0 - f[0])), below = std::abs(normal.dot(e1 - f[0]));
    const double s = share(above, above + below);
    nearest = nearest_of_face(e0 + s * (e1 - e0), f);
    nearest.a = {1 - s, s, 0};
    set_normal(places.edge(v[2], v[3]), places.edge(v[2], v[4]), place);
  }

  // The first feature belongs to the triangle that holds its vertices; no triangle holds both
  // features.
  const auto corner_of = [&](std::int32_t triangle, std::int32_t vertex) {
    for (int corner = 0; corner < 3; ++corner) {
      if (triangles(triangle, corner) == vertex) return corner;
    }
    return -1;
  };
  bool is_turned = false;
  for (std::size_t i = 0; i < count; ++i)
    is_turned |= corner_of(i < of_a ? contact.pair.a : contact.pair.b, v[i]) < 0;
  std::array<Vector3, 2> sums = {Vector3::Zero(), Vector3::Zero()};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t side = (i < of_a) == is_turned ? 1 : 0;
    const double weight = i < of_a ? nearest.a[i] : nearest.b[i - of_a];
    const auto corner = corner_of(side == 0 ? contact.pair.a : contact.pair.b, v[i]);
    if (corner >= 0) place.barycentric[side][static_cast<std::size_t>(corner)] = weight;
    sums[side] += weight * places.at(v[i]);
  }
  const Vector3 point = 0.5 * (sums[0] + sums[1]);
  const double off =
      std::max((sums[0] - point).cwiseAbs().maxCoeff(), (sums[1] - point).cwiseAbs().maxCoeff());
  // Numbers below the normal ones are rounded by the least double at most.
  const double least = std::numeric_limits<double>::denorm_min();
  place.error = std::ldexp(off + place_error, places.exponent()) + least;
  for (int k = 0; k < 3; ++k)
    place.point[static_cast<std::size_t>(k)] = std::ldexp(point[k], places.exponent());
  return place;
}

}  // namespace assay::detector
