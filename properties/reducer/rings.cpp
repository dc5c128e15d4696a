#include "properties/reducer/rings.h"

#include <algorithm>

#include "properties/reducer/case_edits.h"

namespace assay::properties {

Rings rings_of(const ReductionSearch& search) {
  const auto& triangles = search.best().triangles;
  const auto vertices = vertex_count(search.best());
  Rings rings;
  rings.distance.assign(vertices, Rings::unreached);
  rings.parent = in_order(vertices);
  rings.neighbours.resize(vertices);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      auto& row = rings.neighbours[at(triangles(t, i))];
      row.push_back(triangles(t, (i + 1) % 3));
      row.push_back(triangles(t, (i + 2) % 3));
    }
  }
  for (auto& row : rings.neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }

  std::vector<std::int32_t> queue;
  auto focus = search.finding().focus;
  std::erase_if(focus, [&](std::int32_t t) { return t < 0 || t >= triangles.rows(); });
  if (focus.empty()) focus.push_back(0);
  for (const auto t : focus) {
    for (int i = 0; i < 3; ++i) {
      auto& distance = rings.distance[at(triangles(t, i))];
      if (distance == Rings::unreached) queue.push_back(triangles(t, i));
      distance = 0;
    }
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const auto v = at(queue[head]);
    rings.farthest = rings.distance[v];
    for (const auto w : rings.neighbours[v]) {
      auto& distance = rings.distance[at(w)];
      if (distance != Rings::unreached) continue;
      distance = rings.distance[v] + 1;
      rings.parent[at(w)] = queue[head];
      queue.push_back(w);
    }
  }
  rings.far_first = in_order(vertices);
  std::stable_sort(rings.far_first.begin(), rings.far_first.end(),
                   [&](auto a, auto b) { return rings.distance[at(a)] > rings.distance[at(b)]; });
  return rings;
}

corpus::Case within(const corpus::Case& c, const Rings& rings, int ring) {
  std::vector<std::uint8_t> keep;
  for (const auto& corners : triangles_of(c)) {
    keep.push_back(std::all_of(corners.begin(), corners.end(),
                               [&](std::int32_t v) { return rings.distance[at(v)] <= ring; }));
  }
  return keep_triangles(c, keep);
}

}  // namespace assay::properties
