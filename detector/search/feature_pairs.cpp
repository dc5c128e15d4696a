#include "detector/search/feature_pairs.h"

#include <bit>
#include <utility>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

// The work of choosing, in box tests: for all vertices and edges of a triangle, for a vertex (of
// some six triangles), and for an edge (of two triangles).
constexpr std::uint64_t work_of_triangle = 24, work_of_vertex = 6, work_of_edge = 3;

using Triangle = std::array<std::int32_t, 3>;

// Returns which corners two triangles share: bit 3 i + j is set if corner i of p is corner j of q.
std::uint32_t shared_corners(const Triangle& p, const Triangle& q) {
  std::uint32_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      shared |= static_cast<std::uint32_t>(p[i] == q[j]) << (3 * i + j);
  }
  return shared;
}

// Returns, for each set of shared corners, the pairs of features without a common vertex, as
// feature_bits.
constexpr std::array<std::uint32_t, 512> pairs_without_shared_corner() {
  using namespace feature_bits;
  std::array<std::uint32_t, 512> pairs{};
  for (std::uint32_t shared = 0; shared < 512; ++shared) {
    const auto row = [&](std::size_t i) { return (shared >> (3 * (i % 3)) & 7) != 0; };
    const auto column = [&](std::size_t j) { return (shared >> (j % 3) & 0111) != 0; };
    const auto both = [&](std::size_t i, std::size_t j) {
      return (shared >> (3 * (i % 3) + j % 3) & 1) != 0;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      if (!row(i)) pairs[shared] |= corner_on_face(i);
      if (!column(i)) pairs[shared] |= face_on_corner(i);
      if (!row(i + 1) && !row(i + 2)) pairs[shared] |= edge_at_start(i);
      if (!column(i + 1) && !column(i + 2)) pairs[shared] |= face_at_start(i);
      for (std::size_t j = 0; j < 3; ++j) {
        if (!both(i + 1, j + 1) && !both(i + 1, j + 2) && !both(i + 2, j + 1) &&
            !both(i + 2, j + 2)) {
          pairs[shared] |= edges(i, j);
        }
      }
    }
  }
  return pairs;
}

constexpr auto without_shared_corner = pairs_without_shared_corner();

// Calls visit(i) for each bit i that is set, ascending.
template <class Visit>
void for_each_bit(std::uint32_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

// Returns the pairs of features that two triangles stand for, as feature_bits.
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

Representatives::Representatives(const Topology& mesh, PacedStop* pace) {
  const std::vector<TriangleType> types(mesh.triangles.size(), TriangleType::positive);
  choose_all(mesh, types, pace);
}

RepresentedFeatures Representatives::lowest_of(std::int32_t t, const Topology& mesh) {
  unsigned features = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = mesh.triangles[at(t)][i], e = mesh.triangle_edges[at(t)][i];
    features |= unsigned{mesh.vertex_triangles.row(v).front() == t} << i |
                unsigned{mesh.edge_triangles.row(e).front() == t} << (3 + i);
  }
  return static_cast<RepresentedFeatures>(features);
}

// Most features lie between triangles of one type, and the lowest of these triangles represents
// them. Each triangle finds out by itself whether it is the lowest, so the workers share the
// triangles.
bool Representatives::choose_all(const Topology& mesh, const std::vector<TriangleType>& types,
                                 PacedStop* pace) {
  const bool one_type = are_of_one_type(types);
  features_.resize(mesh.triangles.size());
  vertex_types_.resize(mesh.vertex_triangles.starts.size() - 1);
  edge_types_.resize(mesh.edges.size());
  const auto types_of = [&](std::span<const std::int32_t> holders) {
    if (one_type) return holders.empty() ? TypeSet{0} : set_of(types[0]);
    TypeSet set = 0;
    for (const auto t : holders) set |= set_of(types[at(t)]);
    return set;
  };
  const auto around_vertex = [&](std::size_t v) {
    vertex_types_[v] = types_of(mesh.vertex_triangles.row(static_cast<std::int32_t>(v)));
  };
  const auto around_edge = [&](std::size_t e) {
    edge_types_[e] = types_of(mesh.edge_triangles.row(static_cast<std::int32_t>(e)));
  };
  const auto of_triangle = [&](std::size_t t) {
    features_[t] = lowest_of(static_cast<std::int32_t>(t), mesh);
  };
  const bool were_lowest = std::exchange(are_lowest_, false);
  if (one_type) edge_types_.assign(edge_types_.size(), set_of(types[0]));  // each has a triangle
  const bool is_done =
      for_all_paced(vertex_types_.size(), work_of_vertex, pace, around_vertex) &&
      (one_type || for_all_paced(edge_types_.size(), work_of_edge, pace, around_edge)) &&
      (were_lowest || for_all_paced(features_.size(), work_of_triangle, pace, of_triangle)) &&
      (one_type || choose_between_types(mesh, types, pace));
  are_lowest_ = is_done && one_type;
  return is_done;
}

// For the few features between triangles of several types, one thread chooses, one feature after
// the other.
bool Representatives::choose_between_types(const Topology& mesh,
                                           const std::vector<TriangleType>& types,
                                           PacedStop* pace) {
  constexpr std::uint64_t work_of_look = 1;
  const auto around_vertex = [&](std::size_t v) {
    if (is_single(vertex_types_[v])) return;
    const auto vertex = static_cast<std::int32_t>(v);
    choose(mesh.triangles, mesh.vertex_triangles.row(vertex), vertex, 0, types);
  };
  const auto around_edge = [&](std::size_t e) {
    if (is_single(edge_types_[e])) return;
    const auto edge = static_cast<std::int32_t>(e);
    choose(mesh.triangle_edges, mesh.edge_triangles.row(edge), edge, 3, types);
  };
  return for_each_paced(vertex_types_.size(), work_of_look, pace, around_vertex) &&
         for_each_paced(edge_types_.size(), work_of_look, pace, around_edge);
}

bool Representatives::update(const Topology& mesh, const std::vector<TriangleType>& types,
                             std::span<const std::int32_t> changed, PacedStop* pace) {
  if (features_.empty()) return are_of_one_type(types) || choose_all(mesh, types, pace);
  // Each changed triangle makes all its vertices and edges choose anew. If many triangles have
  // changed, it is cheaper to choose everything anew, once.
  if (changed.size() > mesh.triangles.size() / 4) return choose_all(mesh, types, pace);
  are_lowest_ = are_lowest_ && changed.empty();
  return for_each_paced(changed.size(), work_of_triangle, pace, [&](std::size_t i) {
    const auto t = changed[i];
    for (const auto v : mesh.triangles[at(t)]) {
      vertex_types_[at(v)] = choose(mesh.triangles, mesh.vertex_triangles.row(v), v, 0, types);
    }
    for (const auto e : mesh.triangle_edges[at(t)]) {
      edge_types_[at(e)] = choose(mesh.triangle_edges, mesh.edge_triangles.row(e), e, 3, types);
    }
  });
}

TypeSet Representatives::choose(std::span<const std::array<std::int32_t, 3>> lists,
                                std::span<const std::int32_t> holders, std::int32_t index,
                                int first_bit, const std::vector<TriangleType>& types) {
  TypeSet set = 0;
  for (const auto t : holders) {
    const auto& list = lists[at(t)];
    const int place = list[0] == index ? 0 : list[1] == index ? 1 : 2;
    const auto bit = static_cast<RepresentedFeatures>(1u << (first_bit + place));
    const TypeSet type = set_of(types[at(t)]);
    features_[at(t)] = static_cast<RepresentedFeatures>(set & type ? features_[at(t)] & ~bit
                                                                   : features_[at(t)] | bit);
    set |= type;
  }
  return set;
}

void FeaturePairs::ask(const AskedTypes& relations) {
  relations_ = relations;
  // If all triangles have one type, a first search asks for all of them, and each feature has one
  // representative. In a closure types change from round to round.
  asks_by_types_ = !are_of_one_type(types_) || !relations.within_before.is_empty();
}

bool FeaturePairs::takes(bool within, const Holder& first, const Holder& second) const {
  if (within && relations_.within_before.holds_for_some(first.types, second.types)) return false;
  if (is_single(first.types) && is_single(second.types)) return true;
  const TypeRelation& now = within ? relations_.within_now : relations_.across_now;
  return now.is_first(first.type, first.types, second.type, second.types);
}

void FeaturePairs::append(std::int32_t a, std::int32_t b, bool may_pierce,
                          std::vector<FeatureKey>& keys) const {
  const auto &p = mesh_.triangles[at(a)], &q = mesh_.triangles[at(b)];
  const std::uint32_t pairs =
      represented_pairs(representatives_.of(a, mesh_), representatives_.of(b, mesh_), may_pierce) &
      without_shared_corner[shared_corners(p, q)];
  if (pairs == 0) return;
  const bool within =
      asks_by_types_ && mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
  if (within && relations_.within_before.holds(types_[at(a)], types_[at(b)])) return;
  const auto floats = [&](std::int32_t v) { return points_.start(v).floats(); };
  const TriangleCorners of_a = {floats(p[0]), floats(p[1]), floats(p[2])};
  const TriangleCorners of_b = {floats(q[0]), floats(q[1]), floats(q[2])};
  const std::uint32_t found = kernels_.compare_features(of_a, of_b, points_.floats_to_end(),
                                                        points_.margin().floats(), pairs);
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
    const TriangleType type = types_[at(face)];
    if (!asks_by_types_ ||
        takes(within, {types_[at(t)], representatives_.types_of_vertex(v)}, {type, set_of(type)})) {
      keys.push_back(key_of(FeatureKind::vertex_face, v, face));
    }
  });
}

void FeaturePairs::edges_on_edges(std::uint32_t edges, bool within, std::int32_t a, std::int32_t b,
                                  std::vector<FeatureKey>& keys) const {
  for_each_bit(edges, [&](std::size_t ij) {
    auto e = mesh_.triangle_edges[at(a)][ij / 3], f = mesh_.triangle_edges[at(b)][ij % 3];
    // The key is the same, whichever of the two triangles comes first.
    const bool turned = e > f;
    if (turned) std::swap(e, f);
    if (!asks_by_types_ ||
        takes(within, {types_[at(turned ? b : a)], representatives_.types_of_edge(e)},
              {types_[at(turned ? a : b)], representatives_.types_of_edge(f)})) {
      keys.push_back(key_of(FeatureKind::edge_edge, e, f));
    }
  });
}

void FeaturePairs::edges_through_face(std::uint32_t edges, bool within, std::int32_t t,
                                      std::int32_t face, std::vector<FeatureKey>& keys) const {
  for_each_bit(edges, [&](std::size_t i) {
    const std::int32_t edge = mesh_.triangle_edges[at(t)][i];
    // Inside a component only dirty triangles are asked for piercing, so there is one pair of
    // types.
    const TriangleType type = types_[at(face)];
    if (asks_by_types_ && !within &&
        !takes(within, {types_[at(t)], representatives_.types_of_edge(edge)},
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
  constexpr std::uint64_t work_of_point = 8;
  grid_ = FloatGrid(motion, pace);
  if (pace && pace->stopped()) return;
  const float along = grid_.diagonal_margin(separation);
  margin_.diagonals = FloatLanes{along, along, along, along};
  margin_.axes = grid_.margin(separation);
  const auto count = static_cast<std::size_t>(motion.size());
  const std::size_t ends = motion.is_at_rest() ? 1 : 2;
  if (ends_ < ends) points_ = LargeArray<FeaturePoint>(ends * count);
  ends_ = ends;
  for_all_paced(count, work_of_point, pace, [&](std::size_t v) {
    const auto vertex = static_cast<std::int32_t>(v);
    const RoundedPoint axes = grid_(motion, vertex);
    points_[ends * v] = {axes.t0, diagonals(grid_.scaled(motion.vertices_t0, vertex))};
    if (ends == 1) return;
    points_[ends * v + 1] = {axes.t1, diagonals(grid_.scaled(motion.vertices_t1, vertex))};
  });
}

}  // namespace assay::detector
