#include "detector/search/representatives.h"

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

// The work, in box tests, of choosing for a vertex (some six triangles lie around it), for an edge
// (two do), and for all vertices and edges of a triangle.
constexpr std::uint64_t work_of_triangle = 24, work_of_vertex = 6, work_of_edge = 3;

}  // namespace

Representatives::Representatives(const Topology& mesh, PacedStop* pace)
    : features_(mesh.triangles.size()),
      vertex_types_(mesh.vertex_triangles.starts.size() - 1),
      edge_types_(mesh.edges.size()) {
  const std::vector<TriangleType> types(mesh.triangles.size(), TriangleType::positive);
  choose_all(mesh, types, pace);
}

// Most features lie between triangles of one type, and the lowest of these represents them. Each
// triangle finds out for itself whether it does, so the workers share the triangles out.
bool Representatives::choose_all(const Topology& mesh, const std::vector<TriangleType>& types,
                                 PacedStop* pace) {
  const auto types_of = [&](std::span<const std::int32_t> holders) {
    TypeSet seen = 0;
    for (const auto t : holders) seen |= set_of(types[at(t)]);
    return seen;
  };
  const auto lowest_of = [&](std::int32_t t) {
    unsigned features = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = mesh.triangles[at(t)][i], e = mesh.triangle_edges[at(t)][i];
      features |= unsigned{mesh.vertex_triangles.row(v).front() == t} << i |
                  unsigned{mesh.edge_triangles.row(e).front() == t} << (3 + i);
    }
    return static_cast<RepresentedFeatures>(features);
  };
  const auto around_vertex = [&](std::size_t v) {
    vertex_types_[v] = types_of(mesh.vertex_triangles.row(static_cast<std::int32_t>(v)));
  };
  const auto around_edge = [&](std::size_t e) {
    edge_types_[e] = types_of(mesh.edge_triangles.row(static_cast<std::int32_t>(e)));
  };
  const auto of_triangle = [&](std::size_t t) {
    features_[t] = lowest_of(static_cast<std::int32_t>(t));
  };
  return for_all_paced(vertex_types_.size(), work_of_vertex, pace, around_vertex) &&
         for_all_paced(edge_types_.size(), work_of_edge, pace, around_edge) &&
         for_all_paced(features_.size(), work_of_triangle, pace, of_triangle) &&
         choose_between_types(mesh, types, pace);
}

// The few features between triangles of several types: one thread chooses for one after the other.
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
  // A vertex or an edge is chosen for once for each changed triangle that holds it. If many have
  // changed it is cheaper to choose everything anew, once.
  if (changed.size() > mesh.triangles.size() / 4) return choose_all(mesh, types, pace);
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

TypeSet Representatives::choose(const std::vector<std::array<std::int32_t, 3>>& lists,
                                std::span<const std::int32_t> holders, std::int32_t index,
                                int first_bit, const std::vector<TriangleType>& types) {
  TypeSet seen = 0;
  for (const auto t : holders) {
    const auto& list = lists[at(t)];
    const int place = list[0] == index ? 0 : list[1] == index ? 1 : 2;
    const auto bit = static_cast<RepresentedFeatures>(1u << (first_bit + place));
    const TypeSet type = set_of(types[at(t)]);
    features_[at(t)] = static_cast<RepresentedFeatures>(seen & type ? features_[at(t)] & ~bit
                                                                    : features_[at(t)] | bit);
    seen |= type;
  }
  return seen;
}

}  // namespace assay::detector
