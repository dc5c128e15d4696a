// Passes that drop triangles, whether or not the mesh stays closed (passes.h).
#include <algorithm>

#include "detector/mesh/topology.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes/passes.h"
#include "properties/reducer/rings.h"

namespace assay::properties {
namespace {

using detector::make_topology;

// The triangles, those farthest from the focus first.
std::vector<std::int32_t> far_triangles_first(const ReductionSearch& search) {
  const Rings rings = rings_of(search);
  const auto triangles = triangles_of(search.best());
  std::vector<std::int32_t> order(triangles.size());
  std::vector<int> distance(triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    order[t] = static_cast<std::int32_t>(t);
    for (const auto v : triangles[t]) {
      distance[t] = std::max(distance[t], rings.distance[at(v)]);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return distance[at(a)] > distance[at(b)]; });
  return order;
}

}  // namespace

void drop_components(ReductionSearch& search) {
  const auto components = [&] {
    const auto& c = search.best();
    return make_topology(c.triangles, c.frames.front().rows()).components;
  };
  const auto size = [&] { return components().size(); };
  if (size() < 2) return;
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    const auto all = components();
    if (end - begin == all.size()) return false;
    std::vector<std::uint8_t> keep(static_cast<std::size_t>(search.best().triangles.rows()), 1);
    for (std::size_t i = begin; i < end; ++i) {
      for (const auto t : all[i].triangles) keep[at(t)] = 0;
    }
    return search.offer(keep_triangles(search.best(), keep));
  });
}

void keep_rings(ReductionSearch& search) {
  const Rings rings = rings_of(search);
  const auto triangles = triangles_of(search.best());
  if (!search.finding().focus.empty()) {
    std::vector<std::uint8_t> keep(triangles.size(), 0);
    for (const auto t : search.finding().focus) keep.at(at(t)) = 1;
    if (search.offer(keep_triangles(search.best(), keep))) return;
  }
  for (int ring = 0; ring < rings.farthest; ++ring) {
    if (search.offer(within(search.best(), rings, ring))) return;
  }
}

void drop_faces(ReductionSearch& search) {
  const auto size = [&] { return static_cast<std::size_t>(search.best().triangles.rows()); };
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    const auto order = far_triangles_first(search);
    if (end - begin == order.size()) return false;
    std::vector<std::uint8_t> keep(order.size(), 1);
    for (std::size_t i = begin; i < end; ++i) keep[at(order[i])] = 0;
    return search.offer(keep_triangles(search.best(), keep));
  });
}

void drop_unused_vertices(ReductionSearch& search) {
  search.offer(with_triangles(search.best(), triangles_of(search.best())));
}

void drop_ghosts(ReductionSearch& search) {
  if (!search.best().ghosts) return;
  corpus::Case without = search.best();
  without.ghosts.reset();
  search.offer(without);
}

}  // namespace assay::properties
