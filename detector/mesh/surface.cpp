#include "detector/mesh/surface.h"

#include <cassert>
#include <utility>

#include "detector/mesh/for_all.h"

namespace assay::detector {

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  return make_surface(triangles, vertex_count, pace);
}

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace) {
  Surface surface = surface_without_ghosts(triangles, vertex_count, pace);
  if (!pace.stopped()) add_ghosts(surface, pace);
  return surface;
}

Surface surface_without_ghosts(const TrianglesView& triangles, Eigen::Index vertex_count,
                               PacedStop& pace) {
  Surface surface;
  surface.mesh = make_topology(triangles, vertex_count, pace);
  if (pace.stopped()) return surface;
  surface.loops = boundary_loops(surface.mesh, pace);
  surface.first_apex = static_cast<std::int32_t>(vertex_count);
  return surface;
}

void add_ghosts(Surface& surface, PacedStop& pace) {
  constexpr std::uint64_t work_of_ghost = 4;
  if (surface.is_closed()) return;
  std::size_t ghosts = 0;
  for (const auto& loop : surface.loops) ghosts += loop.size();
  const auto own = static_cast<Eigen::Index>(surface.mesh.triangles.size());
  Triangles all(own + static_cast<Eigen::Index>(ghosts), 3);
  all.topRows(own) = Eigen::Map<const Triangles>(surface.mesh.triangles[0].data(), own, 3);
  Eigen::Index row = own;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const auto& loop = surface.loops[l];
    const auto apex = surface.first_apex + static_cast<std::int32_t>(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      all.row(row++) << loop[(i + 1) % loop.size()], loop[i], apex;
    }
    if (pace.after(work_of_ghost * loop.size())) return;
  }
  surface.with_ghosts = make_topology(
      all, surface.first_apex + static_cast<Eigen::Index>(surface.loops.size()), pace);
  // A loop stays within one component, so its ghosts join no two components. Apexes have higher
  // indices than all vertices, so no component changes its place.
  assert(pace.stopped() || surface.with_ghosts.components.size() == surface.mesh.components.size());
}

namespace {

constexpr std::uint64_t work_of_edge = 2;  // in box tests

struct LoopEdge {
  std::int32_t from, to;
};

// Returns the unmatched edges, ascending by their first vertex, then by their second.
std::vector<LoopEdge> unmatched_edges(const Topology& mesh, PacedStop& pace) {
  std::vector<LoopEdge> unmatched;
  const auto take = [&](std::size_t i) {
    const auto& [edge, surplus] = mesh.unmatched[i];
    const auto [u, v] = mesh.edges[at(edge)];
    for (std::int32_t k = 0; k < surplus; ++k) unmatched.push_back({u, v});
    for (std::int32_t k = 0; k < -surplus; ++k) unmatched.push_back({v, u});
  };
  if (!for_each_paced(mesh.unmatched.size(), work_of_edge, pace, take)) return {};
  const std::size_t vertices = mesh.vertex_triangles.starts.size();
  for (const auto end : {&LoopEdge::to, &LoopEdge::from}) {
    const auto row_of = [&](std::size_t i) { return std::array{unmatched[i].*end}; };
    Incidence by_vertex;
    if (unmatched.empty() || !list_by_row(unmatched.size(), vertices, row_of, by_vertex, pace))
      return {};
    std::vector<LoopEdge> sorted;
    for (const auto i : by_vertex.items) sorted.push_back(unmatched[at(i)]);
    unmatched = std::move(sorted);
  }
  return unmatched;
}

}  // namespace

std::vector<Loop> boundary_loops(const Topology& mesh) {
  PacedStop pace(never_stops);
  return boundary_loops(mesh, pace);
}

std::vector<Loop> boundary_loops(const Topology& mesh, PacedStop& pace) {
  const auto edges = unmatched_edges(mesh, pace);
  if (edges.empty()) return {};
  // The edges that leave a vertex v are consecutive in `edges`; those before next[v] are used.
  std::vector<std::size_t> next(mesh.vertex_triangles.starts.size(), edges.size());
  const auto begin_at = [&](std::size_t i) {
    const std::size_t e = edges.size() - 1 - i;
    next[at(edges[e].from)] = e;
  };
  if (!for_each_paced(edges.size(), work_of_edge, pace, begin_at)) return {};
  const auto take_from = [&](std::int32_t vertex) -> const LoopEdge* {
    auto& e = next[at(vertex)];
    return e < edges.size() && edges[e].from == vertex ? &edges[e++] : nullptr;
  };
  std::vector<Loop> loops;
  for (const auto& [start, ignored] : edges) {
    if (pace.after(work_of_edge)) return {};
    Loop loop;
    for (const auto* edge = take_from(start); edge; edge = take_from(edge->to)) {
      loop.push_back(edge->from);
    }
    if (loop.empty()) continue;
    if (pace.after(work_of_edge * loop.size())) return {};
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace assay::detector
