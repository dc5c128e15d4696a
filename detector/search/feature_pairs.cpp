#include "detector/search/feature_pairs.h"

#include <algorithm>
#include <bit>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

bool contains(const std::array<std::int32_t, 3>& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

// Calls visit(i) for each bit i that is set, ascending.
template <class Visit>
void for_each_bit(std::uint32_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

// The pairs of features that two triangles stand for, as feature_bits.
std::uint32_t represented_pairs(RepresentedFeatures a, RepresentedFeatures b, bool may_pierce) {
  constexpr std::uint32_t three = 7, rows[] = {0, 7, 56, 63, 448, 455, 504, 511};
  const std::uint32_t corners_a = a & three, corners_b = b & three;
  const std::uint32_t edges_a = a >> 3 & three, edges_b = b >> 3 & three;
  constexpr std::uint32_t each_row = 1 + (1 << 3) + (1 << 6);
  std::uint32_t pairs = corners_a | corners_b << 3 | (rows[edges_a] & (edges_b * each_row)) << 6;
  if (may_pierce) pairs |= edges_a << 15 | edges_b << 18;
  return pairs;
}

}  // namespace

void FeaturePairs::ask(const AskedTypes& asked) {
  asked_ = asked;
  asks_by_types_ = true;
}

bool FeaturePairs::takes(bool within, const Holder& first, const Holder& second) const {
  if (!asks_by_types_) return true;
  if (within && asked_.within_before.holds_for_some(first.types, second.types)) return false;
  if (is_single(first.types) && is_single(second.types)) return true;
  const TypeRelation& now = within ? asked_.within_now : asked_.across_now;
  return now.is_first(first.type, first.types, second.type, second.types);
}

void FeaturePairs::append(std::int32_t a, std::int32_t b, bool may_pierce,
                          std::vector<FeatureKey>& keys) const {
  const std::uint32_t asked =
      represented_pairs(representatives_.of(a), representatives_.of(b), may_pierce);
  if (asked == 0) return;
  const bool within = mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
  if (asks_by_types_ && within && asked_.within_before.holds(types_[at(a)], types_[at(b)])) return;
  const auto &p = mesh_.triangles[at(a)], &q = mesh_.triangles[at(b)];
  const TriangleCorners of_a = {points_[p[0]].floats(), points_[p[1]].floats(),
                                points_[p[2]].floats()};
  const TriangleCorners of_b = {points_[q[0]].floats(), points_[q[1]].floats(),
                                points_[q[2]].floats()};
  const std::uint32_t found =
      kernels_.compare_features(of_a, of_b, points_.margin().floats(), asked);
  if (found == 0) return;
  constexpr std::uint32_t three = 7, nine = 511;
  vertices_on_face(found & three, within, a, b, keys);
  vertices_on_face(found >> 3 & three, within, b, a, keys);
  edges_on_edges(found >> 6 & nine, within, a, b, keys);
  edges_through_face(found >> 15 & three, within, a, b, keys);
  edges_through_face(found >> 18 & three, within, b, a, keys);
}

void FeaturePairs::vertices_on_face(std::uint32_t corners, bool within, std::int32_t t,
                                    std::int32_t face, std::vector<FeatureKey>& keys) const {
  for_each_bit(corners, [&](std::size_t i) {
    const std::int32_t v = mesh_.triangles[at(t)][i];
    if (contains(mesh_.triangles[at(face)], v)) return;
    const TriangleType type = types_[at(face)];
    if (takes(within, {types_[at(t)], representatives_.types_of_vertex(v)}, {type, set_of(type)}))
      keys.push_back(key_of(FeatureKind::vertex_face, v, face));
  });
}

void FeaturePairs::edges_on_edges(std::uint32_t edges, bool within, std::int32_t a, std::int32_t b,
                                  std::vector<FeatureKey>& keys) const {
  const auto &p = mesh_.triangles[at(a)], &q = mesh_.triangles[at(b)];
  for_each_bit(edges, [&](std::size_t ij) {
    const std::size_t i = ij / 3, j = ij % 3;
    const auto u0 = p[(i + 1) % 3], u1 = p[(i + 2) % 3];
    const auto v0 = q[(j + 1) % 3], v1 = q[(j + 2) % 3];
    if (u0 == v0 || u0 == v1 || u1 == v0 || u1 == v1) return;
    auto e = mesh_.triangle_edges[at(a)][i], f = mesh_.triangle_edges[at(b)][j];
    Holder first{types_[at(a)], representatives_.types_of_edge(e)};
    Holder second{types_[at(b)], representatives_.types_of_edge(f)};
    if (e > f) {
      // The key is the same, whichever of the two triangles comes first.
      std::swap(e, f);
      std::swap(first, second);
    }
    if (takes(within, first, second)) keys.push_back(key_of(FeatureKind::edge_edge, e, f));
  });
}

void FeaturePairs::edges_through_face(std::uint32_t edges, bool within, std::int32_t t,
                                      std::int32_t face, std::vector<FeatureKey>& keys) const {
  for_each_bit(edges, [&](std::size_t i) {
    const auto &ends = mesh_.triangles[at(t)], &corners = mesh_.triangles[at(face)];
    if (contains(corners, ends[(i + 1) % 3]) || contains(corners, ends[(i + 2) % 3])) return;
    const std::int32_t edge = mesh_.triangle_edges[at(t)][i];
    // Inside a component only dirty triangles are asked for piercing, so there is one pair of
    // types.
    const TriangleType type = types_[at(face)];
    if (!within && !takes(within, {types_[at(t)], representatives_.types_of_edge(edge)},
                          {type, set_of(type)})) {
      return;
    }
    keys.push_back(key_of(FeatureKind::piercing, edge, face));
  });
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
    const RoundedPoint axes = f(motion, vertex);
    points_[v] = {axes.t0, diagonals(f.scaled(motion.vertices_t0, vertex)), axes.t1,
                  diagonals(f.scaled(motion.vertices_t1, vertex))};
  });
}

}  // namespace assay::detector
