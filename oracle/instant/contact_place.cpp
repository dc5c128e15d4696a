// The error of a place. Let M be the largest coordinate of the two triangles, in magnitude.
// - At the time t of the contact both features hold one place. At t.lo, at most 2^-53 before t, the
//   places with the same weights are at most 2^-53 times the lengths of both ways apart, which are
//   at most 2 sqrt(3) M each. So the nearest places of the features at t.lo, which are found
//   exactly, are at most sqrt(3) 2^-51 M apart. The point is between them: sqrt(3) 2^-52 M from
//   each.
// - A weight is rounded by less than 2^-53, so the weighted sum moves by less than 3 * 2^-53 M.
// - The point is rounded by less than 2^-52 M.
// Together this is less than 4.3 * 2^-52 M, and `error` is what it is in the very case, rounded up.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "oracle/instant/instant.h"
#include "oracle/mesh/feature_distance.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

namespace {

using detector::FeatureKind;
using Vertices = std::span<const std::int32_t>;
using Weights = std::array<mpq_class, 3>;  // of the vertices of a feature

// Two features that come nearest to each other at these weights of their vertices.
struct Nearest {
  Weights a, b;
};

Place weighted(std::span<const Place> corners, const Weights& weights) {
  Place sum;
  for (std::size_t i = 0; i < corners.size(); ++i) sum = along(sum, corners[i], weights[i]);
  return sum;
}

// Of a whole that is 0, every part will do.
mpq_class share(const mpq_class& part, const mpq_class& whole) {
  if (whole == 0) return 0;
  return std::clamp<mpq_class>(part / whole, 0, 1);
}

// The shares are clamped one after the other, as in Ericson, Real-Time Collision Detection, 5.1.9.
Nearest nearest_of_edges(const Place& a0, const Place& a1, const Place& b0, const Place& b1) {
  const Place u = minus(a1, a0), v = minus(b1, b0), w = minus(a0, b0);
  const mpq_class uu = squared(u), vv = squared(v), uv = product(u, v), uw = product(u, w),
                  vw = product(v, w);
  mpq_class s = share(uv * vw - uw * vv, uu * vv - uv * uv);
  const mpq_class t = share(uv * s + vw, vv);
  s = share(uv * t - uw, uu);
  return {{1 - s, s, 0}, {1 - t, t, 0}};
}

// If the foot of the point is inside of the face, it is the nearest place; else one of an edge is.
Weights nearest_of_face(const Place& p, const std::array<Place, 3>& f) {
  const Place normal = normal_to(minus(f[1], f[0]), minus(f[2], f[0]));
  if (const mpq_class length = squared(normal); length != 0) {
    Weights weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &from = f[(i + 1) % 3], &to = f[(i + 2) % 3];
      weights[i] = product(normal, normal_to(minus(to, from), minus(p, from))) / length;
    }
    if (std::min({weights[0], weights[1], weights[2]}) >= 0) return weights;
  }
  Weights best;
  mpq_class least = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto on_edge = nearest_of_edges(p, p, f[i], f[j]).b;
    Weights weights;
    weights[i] = on_edge[0];
    weights[j] = on_edge[1];
    const mpq_class distance = squared(minus(p, weighted(f, weights)));
    if (least >= 0 && distance >= least) continue;
    best = std::move(weights);
    least = distance;
  }
  return best;
}

// The mesh at one time.
class Corners {
 public:
  Corners(const detector::SteppedMesh& motion, double t) : motion_(motion), t_(t) {}

  Place at(std::int32_t vertex) const {
    const Place x = place_of(motion_.start(vertex));
    return t_ == 0 ? x : along(x, minus(place_of(motion_.end(vertex)), x), t_);
  }
  std::array<Place, 3> at(const Face& face) const {
    return {at(face[0]), at(face[1]), at(face[2])};
  }

 private:
  const detector::SteppedMesh& motion_;
  const mpq_class t_;
};

Place normal_of(const detector::Feature& feature, const Corners& corners) {
  const auto& v = feature.vertices;
  const auto edge = [&](int from, int to) { return minus(corners.at(v[to]), corners.at(v[from])); };
  switch (feature.kind) {
    case FeatureKind::vertex_face:
      return normal_to(edge(1, 2), edge(1, 3));
    case FeatureKind::edge_edge:
      return normal_to(edge(0, 1), edge(2, 3));
    case FeatureKind::piercing:
      return normal_to(edge(2, 3), edge(2, 4));
    case FeatureKind::same_vertices:
      break;
  }
  return normal_to(edge(0, 1), edge(0, 2));
}

// With c, the vector over its largest coordinate, |c| is in [1, sqrt(3)]. Each of the two other
// coordinates is cut by less than 2^-53, which moves the direction by less than sqrt(2) 2^-53. The
// length in doubles is within 3 * 2^-53 of itself, and the division adds 2^-53: together this is
// less than 6 * 2^-53, and so less than normal_error.
std::optional<detector::Point> unit(const Place& vector) {
  const mpq_class largest =
      std::max({mpq_class(abs(vector[0])), mpq_class(abs(vector[1])), mpq_class(abs(vector[2]))});
  if (largest == 0) return std::nullopt;
  detector::Point c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = mpq_class(vector[k] / largest).get_d();
  const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
  for (double& x : c) x /= length;
  return c;
}

// The weights of the vertices of a feature, in doubles, by the corners of a triangle that holds it.
detector::Point by_corner(const Face& triangle, Vertices vertices, const Weights& weights) {
  detector::Point out{};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto corner = std::find(triangle.begin(), triangle.end(), vertices[i]);
    out[static_cast<std::size_t>(corner - triangle.begin())] += weights[i].get_d();
  }
  return out;
}

double rounded_up(const mpq_class& x) {
  const double d = x.get_d();
  return mpq_class(d) < x ? std::nextafter(d, std::numeric_limits<double>::infinity()) : d;
}

}  // namespace

std::optional<ContactPlace> contact_place(const detector::SteppedMesh& motion,
                                          const detector::TrianglesView& triangles,
                                          const detector::PairContact& contact) {
  const auto kind = contact.feature.kind;
  const auto& v = contact.feature.vertices;
  if (v[0] < 0) return std::nullopt;
  const Corners corners(motion, contact.time.lo);
  const auto face = [&](std::size_t first) { return Face{v[first], v[first + 1], v[first + 2]}; };
  const auto row = [&](std::int32_t t) {
    return Face{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
  };
  std::size_t of_a = 1, of_b = 3;  // how many vertices each feature has
  Nearest nearest{{1, 0, 0}, {}};
  if (kind == FeatureKind::vertex_face) {
    nearest.b = nearest_of_face(corners.at(v[0]), corners.at(face(1)));
  } else if (kind == FeatureKind::edge_edge) {
    of_a = of_b = 2;
    nearest =
        nearest_of_edges(corners.at(v[0]), corners.at(v[1]), corners.at(v[2]), corners.at(v[3]));
  } else if (kind == FeatureKind::piercing) {
    of_a = 2;
    const auto f = corners.at(face(2));
    const Place normal = normal_of(contact.feature, corners), e0 = corners.at(v[0]),
                e1 = corners.at(v[1]);
    const mpq_class height = product(normal, minus(e0, f[0])),
                    fall = product(normal, minus(e0, e1));
    if (fall == 0) return std::nullopt;
    const mpq_class s = share(height, fall);
    nearest = {{1 - s, s, 0}, nearest_of_face(along(e0, minus(e1, e0), s), f)};
  } else {
    of_a = 3;
    const mpq_class third(1, 3);
    nearest = {{third, third, third}, {third, third, third}};
  }
  const Vertices all(v), a = all.first(of_a),
                         b = kind == FeatureKind::same_vertices ? a : all.subspan(of_a, of_b);
  // The first feature is of the triangle that holds its first vertices: no triangle holds both.
  const std::array<Face, 2> pair = {row(contact.pair.a), row(contact.pair.b)};
  const bool is_turned =
      !std::all_of(a.begin(), a.end(), [&](auto w) { return holds(pair[0], w); }) ||
      !std::all_of(b.begin(), b.end(), [&](auto w) { return holds(pair[1], w); });
  ContactPlace place;
  place.barycentric[is_turned ? 1 : 0] = by_corner(pair[is_turned ? 1 : 0], a, nearest.a);
  place.barycentric[is_turned ? 0 : 1] = by_corner(pair[is_turned ? 0 : 1], b, nearest.b);

  const auto places_of = [&](Vertices vertices) {
    std::vector<Place> places;
    for (const auto vertex : vertices) places.push_back(corners.at(vertex));
    return places;
  };
  const Place on_a = weighted(places_of(a), nearest.a), on_b = weighted(places_of(b), nearest.b);
  for (std::size_t k = 0; k < 3; ++k) place.point[k] = mpq_class((on_a[k] + on_b[k]) / 2).get_d();
  mpq_class error = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& given = place.barycentric[side];
    const Place off =
        minus(weighted(corners.at(pair[side]), place_of(given)), place_of(place.point));
    error =
        std::max({error, mpq_class(abs(off[0])), mpq_class(abs(off[1])), mpq_class(abs(off[2]))});
  }
  place.error = rounded_up(error);

  // A normal that turns round between the two doubles around the time is none.
  const Place normal = normal_of(contact.feature, corners);
  const bool is_known =
      contact.time.lo == contact.time.hi ||
      product(normal, normal_of(contact.feature, Corners(motion, contact.time.hi))) > 0;
  if (is_known) place.normal = unit(normal);
  return place;
}

// The differences of the places of two triangles fill a convex body, and the two cross when 0 is
// inside of it. Its sides are normal to a triangle or to an edge of each. If it is flat, all
// normals here are normal to its plane, or 0.
bool triangles_cross(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     const detector::TrianglePair& pair) {
  std::array<detector::MovingPoint, 6> places;
  for (int i = 0; i < 6; ++i) {
    const auto place = detector::point_of(x, triangles(i < 3 ? pair.a : pair.b, i % 3));
    places[i] = {place, place};
  }
  const IntegerScale scale(places);
  std::array<IntegerPoint, 6> corner;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 3; ++k) corner[i][k] = scale(places[i].t0[k]);
  }
  const auto edge = [&](int first, int i) {
    return corner[first + (i + 1) % 3] - corner[first + i];
  };
  bool has_side = false;
  const auto is_inside_of_side = [&](const IntegerPoint& normal) {
    if (normal == IntegerPoint{}) return true;
    has_side = true;
    std::array<Integer, 6> height;
    for (int i = 0; i < 6; ++i) height[i] = dot(normal, corner[i]);
    const auto [a_low, a_high] = std::minmax({height[0], height[1], height[2]});
    const auto [b_low, b_high] = std::minmax({height[3], height[4], height[5]});
    return a_high > b_low && a_low < b_high;
  };
  if (!is_inside_of_side(cross(edge(0, 0), edge(0, 1))) ||
      !is_inside_of_side(cross(edge(3, 0), edge(3, 1))))
    return false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!is_inside_of_side(cross(edge(0, i), edge(3, j)))) return false;
    }
  }
  return has_side;
}

}  // namespace assay::oracle
