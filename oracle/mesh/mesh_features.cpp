#include "oracle/mesh/mesh_features.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace assay::oracle {

namespace {

// Sorts (item, triangle) into unique items and their lists of triangles.
template <class Item>
void group(std::vector<std::pair<Item, std::int32_t>> uses, std::vector<Item>& items,
           Incidence& incidence) {
  std::sort(uses.begin(), uses.end());
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  incidence.triangle.reserve(uses.size());
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (i == 0 || uses[i].first != uses[i - 1].first) {
      items.push_back(uses[i].first);
      incidence.first.push_back(i);
    }
    incidence.triangle.push_back(uses[i].second);
  }
  incidence.first.push_back(uses.size());
}

}  // namespace

MeshFeatures mesh_features(const detector::TrianglesView& triangles) {
  MeshFeatures features;
  const auto count = static_cast<std::int32_t>(triangles.rows());
  std::vector<std::pair<std::int32_t, std::int32_t>> vertex_uses;
  std::vector<std::pair<Edge, std::int32_t>> edge_uses;
  features.faces.reserve(count);
  vertex_uses.reserve(3 * static_cast<std::size_t>(count));
  edge_uses.reserve(3 * static_cast<std::size_t>(count));
  for (std::int32_t t = 0; t < count; ++t) {
    const Face face = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    features.faces.push_back(face);
    for (int k = 0; k < 3; ++k) {
      const std::int32_t from = face[k], to = face[(k + 1) % 3];
      vertex_uses.emplace_back(from, t);
      if (from != to) edge_uses.emplace_back(Edge{std::min(from, to), std::max(from, to)}, t);
    }
  }
  group(std::move(vertex_uses), features.vertices, features.triangles_of_vertex);
  group(std::move(edge_uses), features.edges, features.triangles_of_edge);
  return features;
}

std::vector<detector::TrianglePair> same_vertices_pairs(const std::vector<Face>& faces) {
  std::vector<Face> sorted = faces;
  for (Face& face : sorted) std::sort(face.begin(), face.end());
  std::vector<std::int32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(sorted[a], a) < std::pair(sorted[b], b);
  });
  std::vector<detector::TrianglePair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && sorted[order[i]] == sorted[order[j]]; ++j) {
      pairs.push_back({order[i], order[j]});
    }
  }
  return pairs;
}

namespace {

void add_edges(const detector::TrianglesView& triangles, std::vector<DirectedEdge>& edges) {
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t from = triangles(t, k), to = triangles(t, (k + 1) % 3);
      if (from != to) edges.push_back({from, to});
    }
  }
}

// Returns the edges that are left when opposite ones cancel.
std::vector<DirectedEdge> unmatched(std::vector<DirectedEdge> edges) {
  std::vector<DirectedEdge> reversed;
  reversed.reserve(edges.size());
  for (const auto& [from, to] : edges) reversed.push_back({to, from});
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  std::vector<DirectedEdge> rest;
  // This is a difference of multisets: an edge used k times more one way is kept k times.
  std::set_difference(edges.begin(), edges.end(), reversed.begin(), reversed.end(),
                      std::back_inserter(rest));
  return rest;
}

}  // namespace

std::vector<DirectedEdge> unmatched_edges(const detector::TrianglesView& triangles) {
  std::vector<DirectedEdge> edges;
  add_edges(triangles, edges);
  return unmatched(std::move(edges));
}

std::vector<Loop> boundary_loops(const detector::TrianglesView& triangles) {
  const std::vector<DirectedEdge> edges = unmatched_edges(triangles);
  std::vector<std::uint8_t> used(edges.size(), 0);
  // The edges that leave a vertex are one range of `edges`. The used ones are its front part,
  // because the lowest is always taken. If i is the first place of the range, used_from[i] is the
  // number of used edges.
  std::vector<std::size_t> used_from(edges.size() + 1, 0);
  auto first_from = [&](std::int32_t vertex) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), DirectedEdge{vertex, -1});
    return static_cast<std::size_t>(at - edges.begin());
  };
  // The place of the lowest unused edge that leaves the vertex; edges.size() when there is none.
  auto lowest_from = [&](std::int32_t vertex) {
    const std::size_t first = first_from(vertex), i = first + used_from[first];
    return i < edges.size() && edges[i][0] == vertex ? i : edges.size();
  };
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    Loop& loop = loops.emplace_back();
    for (std::size_t e = start; e != edges.size(); e = lowest_from(edges[e][1])) {
      used[e] = 1;
      ++used_from[first_from(edges[e][0])];
      loop.push_back(edges[e][0]);
    }
  }
  return loops;
}

detector::Triangles ghost_triangles(const std::vector<Loop>& loops, std::int32_t first_apex) {
  std::size_t count = 0;
  for (const Loop& loop : loops) count += loop.size();
  detector::Triangles ghosts(static_cast<Eigen::Index>(count), 3);
  Eigen::Index row = 0;
  std::int32_t apex = first_apex;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      ghosts.row(row++) << loop[(i + 1) % loop.size()], loop[i], apex;
    }
    ++apex;
  }
  return ghosts;
}

bool closes(const detector::TrianglesView& triangles, const detector::TrianglesView& ghosts) {
  std::vector<DirectedEdge> edges;
  add_edges(triangles, edges);
  add_edges(ghosts, edges);
  if (!unmatched(std::move(edges)).empty()) return false;

  const std::set<std::int32_t> mesh_vertices(triangles.data(), triangles.data() + triangles.size());
  std::vector<DirectedEdge> filled;
  for (Eigen::Index g = 0; g < ghosts.rows(); ++g) {
    int apexes = 0;
    for (int k = 0; k < 3; ++k) {
      if (mesh_vertices.count(ghosts(g, k)) > 0) continue;
      ++apexes;
      filled.push_back({ghosts(g, (k + 2) % 3), ghosts(g, (k + 1) % 3)});
    }
    if (apexes != 1) return false;
  }
  std::sort(filled.begin(), filled.end());
  return filled == unmatched_edges(triangles);
}

}  // namespace assay::oracle
