#include "detector/mesh/loops.h"

#include <algorithm>

namespace assay::detector {
namespace {

struct LoopEdge {
  std::int32_t from, to;
  friend auto operator<=>(const LoopEdge&, const LoopEdge&) = default;
};

std::vector<LoopEdge> unmatched_edges(const Topology& mesh) {
  std::vector<std::int32_t> surplus(mesh.edges.size(), 0);  // ascending less descending uses
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto u = mesh.triangles[t][(corner + 1) % 3], v = mesh.triangles[t][(corner + 2) % 3];
      surplus[static_cast<std::size_t>(mesh.triangle_edges[t][corner])] += u < v ? 1 : -1;
    }
  }
  std::vector<LoopEdge> unmatched;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [u, v] = mesh.edges[e];
    for (std::int32_t k = 0; k < surplus[e]; ++k) unmatched.push_back({u, v});
    for (std::int32_t k = 0; k < -surplus[e]; ++k) unmatched.push_back({v, u});
  }
  std::sort(unmatched.begin(), unmatched.end());
  return unmatched;
}

}  // namespace

std::vector<Loop> boundary_loops(const Topology& mesh) {
  const auto edges = unmatched_edges(mesh);
  // The edges that leave a vertex are consecutive; those before `next[v]` are used.
  std::vector<std::size_t> next(mesh.vertex_triangles.starts.size(), edges.size());
  for (std::size_t e = edges.size(); e-- > 0;) next[static_cast<std::size_t>(edges[e].from)] = e;
  const auto take_from = [&](std::int32_t vertex) -> const LoopEdge* {
    auto& e = next[static_cast<std::size_t>(vertex)];
    return e < edges.size() && edges[e].from == vertex ? &edges[e++] : nullptr;
  };
  std::vector<Loop> loops;
  for (const auto& [start, ignored] : edges) {
    Loop loop;
    for (const auto* edge = take_from(start); edge; edge = take_from(edge->to)) {
      loop.push_back(edge->from);
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace assay::detector
