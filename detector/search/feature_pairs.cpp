#include "detector/search/feature_pairs.h"

#include <algorithm>

#include "detector/parallel/for_all.h"

namespace assay::detector {
namespace {

bool contains(const std::array<std::int32_t, 3>& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

}  // namespace

struct FeaturePairs::Triangle {
  std::int32_t index;
  const std::array<std::int32_t, 3>&corners, &edges;
  std::array<const FeaturePoint*, 3> points;
  FeatureBox box;
  TriangleType type;
  RepresentedFeatures represented;

  FeatureBox edge_box(std::size_t i) const {
    return feature_box(*points[(i + 1) % 3], *points[(i + 2) % 3]);
  }
};

struct FeaturePairs::Pair {
  const Triangle &a, &b;
  bool within;  // one component
};

void FeaturePairs::ask(const AskedTypes& asked) {
  asked_ = asked;
  asks_by_types_ = true;
}

FeaturePairs::Triangle FeaturePairs::triangle(std::int32_t t) const {
  const auto& corners = mesh_.triangles[at(t)];
  const std::array<const FeaturePoint*, 3> p = {&points_[corners[0]], &points_[corners[1]],
                                                &points_[corners[2]]};
  return {t,
          corners,
          mesh_.triangle_edges[at(t)],
          p,
          feature_box(*p[0], *p[1], *p[2]),
          types_[at(t)],
          representatives_.of(t)};
}

bool FeaturePairs::takes(const Pair& pair, const Holder& first, const Holder& second) const {
  if (!asks_by_types_) return true;
  if (pair.within && asked_.within_before.holds_for_some(first.types, second.types)) return false;
  if (is_single(first.types) && is_single(second.types)) return true;
  const TypeRelation& now = pair.within ? asked_.within_now : asked_.across_now;
  return now.is_first(first.type, first.types, second.type, second.types);
}

void FeaturePairs::append(std::int32_t a, std::int32_t b, bool may_pierce,
                          std::vector<FeatureKey>& keys) const {
  const bool within = mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
  if (asks_by_types_ && within && asked_.within_before.holds(types_[at(a)], types_[at(b)])) return;
  const Triangle of_a = triangle(a), of_b = triangle(b);
  // The search has compared the boxes along the axes.
  if (apart(of_a.box.diagonals, of_b.box.diagonals, points_.margin().diagonals)) return;
  const Pair pair{of_a, of_b, within};
  vertices_on_face(pair, of_a, of_b, keys);
  vertices_on_face(pair, of_b, of_a, keys);
  edges_on_edges(pair, may_pierce, keys);
}

void FeaturePairs::vertices_on_face(const Pair& pair, const Triangle& vertices_of,
                                    const Triangle& face, std::vector<FeatureKey>& keys) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!represents_corner(vertices_of.represented, i)) continue;
    if (apart(feature_box(*vertices_of.points[i]), face.box, points_.margin())) continue;
    const std::int32_t v = vertices_of.corners[i];
    if (contains(face.corners, v)) continue;
    if (takes(pair, {vertices_of.type, representatives_.types_of_vertex(v)},
              {face.type, set_of(face.type)})) {
      keys.push_back(key_of(FeatureKind::vertex_face, v, face.index));
    }
  }
}

void FeaturePairs::edges_on_edges(const Pair& pair, bool may_pierce,
                                  std::vector<FeatureKey>& keys) const {
  const auto& [a, b, within] = pair;
  std::array<FeatureBox, 3> boxes_of_b;
  std::array<std::size_t, 3> edges_of_b;
  std::size_t count = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    if (!represents_edge(b.represented, j)) continue;
    boxes_of_b[count] = b.edge_box(j);
    if (apart(boxes_of_b[count], a.box, points_.margin())) continue;
    if (may_pierce) edge_through_face(pair, b.edges[j], boxes_of_b[count], b, a, keys);
    edges_of_b[count++] = j;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!represents_edge(a.represented, i)) continue;
    const FeatureBox box = a.edge_box(i);
    if (apart(box, b.box, points_.margin())) continue;
    if (may_pierce) edge_through_face(pair, a.edges[i], box, a, b, keys);
    const auto u0 = a.corners[(i + 1) % 3], u1 = a.corners[(i + 2) % 3];
    for (std::size_t n = 0; n < count; ++n) {
      if (apart(box, boxes_of_b[n], points_.margin())) continue;
      const std::size_t j = edges_of_b[n];
      const auto v0 = b.corners[(j + 1) % 3], v1 = b.corners[(j + 2) % 3];
      if (u0 == v0 || u0 == v1 || u1 == v0 || u1 == v1) continue;
      Holder first{a.type, representatives_.types_of_edge(a.edges[i])};
      Holder second{b.type, representatives_.types_of_edge(b.edges[j])};
      auto e = a.edges[i], f = b.edges[j];
      if (e > f) {
        // The key is the same, whichever of the two triangles comes first.
        std::swap(e, f);
        std::swap(first, second);
      }
      if (takes(pair, first, second)) keys.push_back(key_of(FeatureKind::edge_edge, e, f));
    }
  }
}

void FeaturePairs::edge_through_face(const Pair& pair, std::int32_t edge, const FeatureBox& box,
                                     const Triangle& edge_of, const Triangle& face,
                                     std::vector<FeatureKey>& keys) const {
  const auto& ends = mesh_.edges[at(edge)];
  if (apart_at_start(box.axes, face.box.axes)) return;
  if (contains(face.corners, ends[0]) || contains(face.corners, ends[1])) return;
  // Inside a component only dirty triangles are asked for piercing, so there is one pair of types.
  if (!pair.within && !takes(pair, {edge_of.type, representatives_.types_of_edge(edge)},
                             {face.type, set_of(face.type)})) {
    return;
  }
  keys.push_back(key_of(FeatureKind::piercing, edge, face.index));
}

namespace {

FloatLanes diagonals(const Point& y) {
  return FloatLanes{static_cast<float>(y[0] + y[1] + y[2]), static_cast<float>(y[0] + y[1] - y[2]),
                    static_cast<float>(y[0] - y[1] + y[2]),
                    static_cast<float>(-y[0] + y[1] + y[2])};
}

}  // namespace

void FeaturePoints::assign(const SteppedMesh& motion, PacedStop* pace, double separation) {
  constexpr std::uint64_t work_of_vertex = 8;
  const FloatGrid f(motion, pace);
  if (pace && pace->stopped()) return;
  margin_ = {};
  if (separation > 0) {
    const float along = f.diagonal_margin(separation);
    margin_.axes = f.margin(separation);
    margin_.diagonals = FloatLanes{along, along, along, along};
  }
  const auto count = static_cast<std::size_t>(motion.size());
  if (!points_) points_ = std::make_unique_for_overwrite<FeaturePoint[]>(count);
  for_all_paced(count, work_of_vertex, pace, [&](std::size_t v) {
    const auto vertex = static_cast<std::int32_t>(v);
    points_[v] = {f(motion, vertex),
                  {diagonals(f.scaled(motion.vertices_t0, vertex)),
                   diagonals(f.scaled(motion.vertices_t1, vertex))}};
  });
}

}  // namespace assay::detector
