#include "oracle/mesh/mesh_features.h"

#include <algorithm>
#include <numeric>
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

}  // namespace assay::oracle
