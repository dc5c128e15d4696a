#include "detector/mesh/surface.h"

#include <cassert>
#include <utility>

#include "detector/mesh/sort_by_key.h"

namespace assay::detector {

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  return make_surface(triangles, vertex_count, pace);
}

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace) {
  constexpr std::uint64_t work_of_ghost = 4;
  Surface surface;
  surface.mesh = make_topology(triangles, vertex_count, pace);
  if (pace.stopped()) return surface;
  surface.loops = boundary_loops(surface.mesh, pace);
  surface.first_apex = static_cast<std::int32_t>(vertex_count);
  if (pace.stopped() || surface.is_closed()) return surface;
  std::size_t ghosts = 0;
  for (const auto& loop : surface.loops) ghosts += loop.size();
  Triangles all(triangles.rows() + static_cast<Eigen::Index>(ghosts), 3);
  all.topRows(triangles.rows()) = triangles;
  Eigen::Index row = triangles.rows();
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const auto& loop = surface.loops[l];
    const auto apex = surface.first_apex + static_cast<std::int32_t>(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      all.row(row++) << loop[(i + 1) % loop.size()], loop[i], apex;
    }
    if (pace.after(work_of_ghost * loop.size())) return surface;
  }
  surface.with_ghosts =
      make_topology(all, vertex_count + static_cast<Eigen::Index>(surface.loops.size()), pace);
  // A loop stays within one component, so its ghosts join no two components. Apexes have higher
  // indices than all vertices, so no component changes its place.
  assert(pace.stopped() || surface.with_ghosts.components.size() == surface.mesh.components.size());
  return surface;
}

namespace {

constexpr std::uint64_t work_of_edge = 2;  // in box tests

struct LoopEdge {
  std::int32_t from, to;
};

// The unmatched edges, ascending by their first vertex, then by their second.
std::vector<LoopEdge> unmatched_edges(const Topology& mesh, PacedStop& pace) {
  std::vector<LoopEdge> unmatched, room;
  std::vector<std::int32_t> surplus;
  if (!count_surplus(mesh, surplus, pace)) return {};
  const auto take = [&](std::size_t e) {
    const auto [u, v] = mesh.edges[e];
    for (std::int32_t k = 0; k < surplus[e]; ++k) unmatched.push_back({u, v});
    for (std::int32_t k = 0; k < -surplus[e]; ++k) unmatched.push_back({v, u});
  };
  if (!for_each_paced(mesh.edges.size(), work_of_edge, pace, take) || unmatched.empty()) return {};
  const std::size_t vertices = mesh.vertex_triangles.starts.size();
  const auto to = [](const LoopEdge& edge) { return edge.to; };
  const auto from = [](const LoopEdge& edge) { return edge.from; };
  if (!sort_by_key(unmatched, room, vertices, to, &pace) ||
      !sort_by_key(unmatched, room, vertices, from, &pace)) {
    return {};
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
