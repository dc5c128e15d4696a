#include "tests/properties/worlds/plain_contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "oracle/distance/feature_distance.h"
#include "oracle/query/contact.h"

namespace assay::properties::test {
namespace {

using detector::at, detector::CountedLevel, detector::CountedPairs;

// The relation in a plain way: a table of how many edges join two vertices, and distances as
// fractions of whole numbers.
using Whole = std::array<std::int64_t, 3>;

Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Fraction {
  std::int64_t over, under = 1;
  bool operator<(const Fraction& other) const { return over * other.under < other.over * under; }
};

Fraction squared_to_edge(const Whole& p, const Whole& a, const Whole& b) {
  const Whole e = minus(b, a), w = minus(p, a);
  const std::int64_t length = dot(e, e), foot = dot(w, e);
  if (length == 0 || foot <= 0) return {dot(w, w)};
  if (foot >= length) return {dot(minus(p, b), minus(p, b))};
  return {dot(w, w) * length - foot * foot, length};
}

Fraction squared_to_face(const Whole& p, const std::array<Whole, 3>& f) {
  Fraction least = std::min({squared_to_edge(p, f[0], f[1]), squared_to_edge(p, f[1], f[2]),
                             squared_to_edge(p, f[2], f[0])});
  const Whole n = cross(minus(f[1], f[0]), minus(f[2], f[0]));
  if (dot(n, n) == 0) return least;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(n, cross(minus(f[(i + 1) % 3], f[i]), minus(p, f[i]))) < 0) return least;
  const std::int64_t height = dot(n, minus(p, f[0]));
  return std::min(least, Fraction{height * height, dot(n, n)});
}

Fraction squared_of_edges(const std::array<Whole, 2>& a, const std::array<Whole, 2>& b) {
  Fraction least = std::min({squared_to_edge(a[0], b[0], b[1]), squared_to_edge(a[1], b[0], b[1]),
                             squared_to_edge(b[0], a[0], a[1]), squared_to_edge(b[1], a[0], a[1])});
  const Whole u = minus(a[1], a[0]), v = minus(b[1], b[0]), w = minus(a[0], b[0]);
  const auto uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const auto d = uu * vv - uv * uv, s = uv * vw - vv * uw, t = uu * vw - uv * uw;
  if (d == 0 || s < 0 || s > d || t < 0 || t > d) return least;
  const Whole n = cross(u, v);
  return std::min(least, Fraction{dot(w, n) * dot(w, n), dot(n, n)});
}

class PlainRelation {
 public:
  PlainRelation(const CountedPairs& counted, const detector::Triangles& triangles,
                std::size_t vertices)
      : counted_(counted),
        triangles_(triangles),
        edges_(vertices, std::vector<int>(vertices, far)) {
    for (std::size_t v = 0; v < vertices; ++v) edges_[v][v] = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (i != j) edges_[at(triangles(t, i))][at(triangles(t, j))] = 1;
    for (std::size_t k = 0; k < vertices; ++k)
      for (std::size_t i = 0; i < vertices; ++i)
        for (std::size_t j = 0; j < vertices; ++j)
          edges_[i][j] = std::min(edges_[i][j], edges_[i][k] + edges_[k][j]);
  }

  using Vertices = std::vector<std::int32_t>;
  Vertices corners(std::int32_t t) const {
    return {triangles_(t, 0), triangles_(t, 1), triangles_(t, 2)};
  }

  // Whether two features, or two triangles, count; `nearer` says whether they are too near at rest.
  template <class Nearer>
  bool may_count(const Vertices& a, const Vertices& b, const Nearer& nearer) const {
    const auto body = [&](std::int32_t v) {
      return counted_.body.empty() ? 0 : counted_.body[at(v)];
    };
    for (const auto& [b0, b1] : counted_.apart) {
      const auto c0 = body(a[0]), c1 = body(b[0]);
      if ((b0 == c0 && b1 == c1) || (b0 == c1 && b1 == c0)) return false;
    }
    for (const auto u : a)
      for (const auto v : b)
        if (edges_[at(u)][at(v)] < counted_.rings) return false;
    return counted_.rest_distance == 0 || !nearer();
  }

  bool counts_vertex(std::int32_t v, std::int32_t t) const {
    for (const auto& pair : counted_.vertex_faces)
      if (pair.vertex == v && pair.face == t) return false;
    return may_count({v}, corners(t), [&] { return near_vertex(v, t); });
  }

  bool counts_edges(std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b) const {
    const auto same = [](const auto& e, const auto& f) {
      return e == f || (e[0] == f[1] && e[1] == f[0]);
    };
    for (const auto& pair : counted_.edge_pairs)
      if ((same(pair.a, a) && same(pair.b, b)) || (same(pair.a, b) && same(pair.b, a)))
        return false;
    return may_count({a[0], a[1]}, {b[0], b[1]}, [&] { return near_edges(a, b); });
  }

  bool counts_triangles(std::int32_t a, std::int32_t b) const {
    for (const auto& pair : counted_.triangle_pairs)
      if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return false;
    return may_count(corners(a), corners(b), [&] { return near_triangles(a, b); });
  }

 private:
  static constexpr int far = 1000;
  Whole place(std::int32_t v) const {
    const auto& x = counted_.rest[at(v)];
    return {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
  }
  std::array<Whole, 3> face(std::int32_t t) const {
    return {place(triangles_(t, 0)), place(triangles_(t, 1)), place(triangles_(t, 2))};
  }
  bool is_near(const Fraction& squared) const {
    const auto halves = std::llround(2 * counted_.rest_distance);
    return squared < Fraction{halves * halves, 4};
  }
  bool near_vertex(std::int32_t v, std::int32_t t) const {
    return is_near(squared_to_face(place(v), face(t)));
  }
  bool near_edges(std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b) const {
    return is_near(squared_of_edges({place(a[0]), place(a[1])}, {place(b[0]), place(b[1])}));
  }
  bool near_triangles(std::int32_t a, std::int32_t b) const {
    for (int i = 0; i < 3; ++i) {
      const auto u = triangles_(a, i), u1 = triangles_(a, (i + 1) % 3);
      if (near_vertex(u, b) || near_vertex(triangles_(b, i), a)) return true;
      for (int j = 0; j < 3; ++j) {
        const auto v = triangles_(b, j), v1 = triangles_(b, (j + 1) % 3);
        if (near_edges({u, u1}, {v, v1})) return true;
        const auto& x = counted_.rest;
        const auto pierces = [&](std::int32_t e0, std::int32_t e1, std::int32_t t) {
          return oracle::segment_pierces_triangle(
              x[at(e0)], x[at(e1)],
              {x[at(triangles_(t, 0))], x[at(triangles_(t, 1))], x[at(triangles_(t, 2))]});
        };
        if (pierces(u, u1, b) || pierces(v, v1, a)) return true;
      }
    }
    return false;
  }

  const CountedPairs& counted_;
  const detector::Triangles& triangles_;
  std::vector<std::vector<int>> edges_;  // how many join two vertices
};

// Two triangles, and all that may meet of them.
struct PlainPair {
  const detector::SteppedMesh& motion_;
  const PlainRelation& relation_;
  const bool of_features_;
  const double separation_;
  const std::int32_t a_, b_;
  std::optional<detector::TimeEnclosure> least_ = {};
  bool some_counts_ = false, pierced_ = false;

  // The first time of what counts.
  std::optional<detector::TimeEnclosure> first() {
    if (!of_features_ && !relation_.counts_triangles(a_, b_)) return std::nullopt;
    if (separation_ > 0 ? share_a_vertex() : boxes_apart()) return std::nullopt;
    vertices_on(a_, b_);
    vertices_on(b_, a_);
    const auto p = relation_.corners(a_), q = relation_.corners(b_);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) edges({p[i], p[(i + 1) % 3]}, {q[j], q[(j + 1) % 3]});
    for (std::size_t i = 0; i < 3; ++i) {
      pierces({p[i], p[(i + 1) % 3]}, q);
      pierces({q[i], q[(i + 1) % 3]}, p);
    }
    if (pierced_ && (!of_features_ || some_counts_)) return detector::TimeEnclosure{0, 0};
    return least_;
  }

  using Vertices = PlainRelation::Vertices;
  static bool holds(const Vertices& list, std::int32_t v) {
    return std::find(list.begin(), list.end(), v) != list.end();
  }
  bool share_a_vertex() const {
    const auto p = relation_.corners(a_), q = relation_.corners(b_);
    return std::any_of(p.begin(), p.end(), [&](std::int32_t v) { return holds(q, v); });
  }
  bool boxes_apart() const {
    for (int k = 0; k < 3; ++k) {
      double low[2], high[2];
      for (const int side : {0, 1}) {
        low[side] = 1e300;
        high[side] = -1e300;
        for (const auto v : relation_.corners(side == 0 ? a_ : b_)) {
          for (const double x : {motion_.vertices_t0(v, k), motion_.vertices_t1(v, k)}) {
            low[side] = std::min(low[side], x);
            high[side] = std::max(high[side], x);
          }
        }
      }
      if (low[0] > high[1] || low[1] > high[0]) return true;
    }
    return false;
  }
  void ask(bool counts, const detector::FourPoints& features) {
    if (!counts) return;
    std::optional<detector::TimeEnclosure> first;
    if (separation_ > 0) {
      const auto near = oracle::first_time_within(features, {separation_, 0});
      if (near.near) first = near.first;
    } else {
      const auto met = oracle::contact_of(features, detector::Want::first_time);
      if (met.contact) first = met.first;
    }
    if (first && (!least_ || *first < *least_)) least_ = first;
  }
  void vertices_on(std::int32_t of, std::int32_t face) {
    const auto f = relation_.corners(face);
    for (const auto v : relation_.corners(of)) {
      if (holds(f, v)) continue;
      const bool counts = !of_features_ || relation_.counts_vertex(v, face);
      some_counts_ |= counts;
      ask(counts,
          {{motion_.path(v), motion_.path(f[0]), motion_.path(f[1]), motion_.path(f[2])}, 1});
    }
  }
  void edges(std::array<std::int32_t, 2> e, std::array<std::int32_t, 2> f) {
    if (holds({f[0], f[1]}, e[0]) || holds({f[0], f[1]}, e[1])) return;
    const bool counts = !of_features_ || relation_.counts_edges(e, f);
    some_counts_ |= counts;
    ask(counts,
        {{motion_.path(e[0]), motion_.path(e[1]), motion_.path(f[0]), motion_.path(f[1])}, 2});
  }
  void pierces(std::array<std::int32_t, 2> e, const Vertices& f) {
    if (holds(f, e[0]) || holds(f, e[1])) return;
    pierced_ |= oracle::segment_pierces_triangle(
        motion_.start(e[0]), motion_.start(e[1]),
        {motion_.start(f[0]), motion_.start(f[1]), motion_.start(f[2])});
  }
};

}  // namespace

std::vector<detector::PairContact> plain_contacts(const detector::SteppedMesh& motion,
                                                  const detector::Triangles& triangles,
                                                  const CountedPairs& counted, double separation) {
  const PlainRelation relation(counted, triangles, static_cast<std::size_t>(motion.size()));
  const bool of_features = counted.level == CountedLevel::features;
  std::vector<detector::PairContact> contacts;
  for (std::int32_t a = 0; a < triangles.rows(); ++a)
    for (std::int32_t b = a + 1; b < triangles.rows(); ++b)
      if (const auto time = PlainPair{motion, relation, of_features, separation, a, b}.first())
        contacts.push_back({{a, b}, *time, {}});
  return contacts;
}

}  // namespace assay::properties::test
