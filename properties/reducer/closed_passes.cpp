// Smaller meshes that stay closed where they are closed: see passes.h. All but the cuts are
// identifications of vertices (merge_vertices), under which a cycle stays a cycle.
#include <algorithm>
#include <numeric>

#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes.h"
#include "properties/reducer/rings.h"

namespace assay::properties {
namespace {

using Targets = std::vector<std::int32_t>;

std::size_t vertex_count(const ReductionSearch& search) {
  return static_cast<std::size_t>(search.best().frames.front().rows());
}

Targets stay(std::size_t vertices) {
  Targets targets(vertices);
  std::iota(targets.begin(), targets.end(), 0);
  return targets;
}

bool offer_merge(ReductionSearch& search, const Targets& targets) {
  return search.offer(merge_vertices(search.best(), targets));
}

// The vertices outside the focus in groups of those within `radius` edges of a centre, which comes
// first; each vertex in one group, groups of one left out.
std::vector<std::vector<std::int32_t>> balls(const Rings& rings, int radius) {
  std::vector<std::uint8_t> taken(rings.distance.size(), 0);
  std::vector<std::vector<std::int32_t>> all;
  for (const auto centre : rings.far_first) {
    if (taken[static_cast<std::size_t>(centre)] != 0 ||
        rings.distance[static_cast<std::size_t>(centre)] == 0) {
      continue;
    }
    taken[static_cast<std::size_t>(centre)] = 1;
    std::vector<std::int32_t> ball = {centre};
    std::size_t begin = 0;
    for (int r = 0; r < radius; ++r) {
      for (const std::size_t end = ball.size(); begin < end; ++begin) {
        for (const auto v : rings.neighbours[static_cast<std::size_t>(ball[begin])]) {
          const auto at = static_cast<std::size_t>(v);
          if (taken[at] != 0 || rings.distance[at] == 0) continue;
          taken[at] = 1;
          ball.push_back(v);
        }
      }
    }
    if (ball.size() > 1) all.push_back(std::move(ball));
  }
  return all;
}

// Largest loop of which every corner is tried as the place of the fan.
constexpr std::size_t most_corners = 12;

}  // namespace

void cone_outside(ReductionSearch& search) {
  for (int ring = 0; ring <= rings_of(search).farthest && !search.ended(); ++ring) {
    const Rings rings = rings_of(search);
    std::vector<std::int32_t> outside;
    for (const auto v : rings.far_first) {
      if (rings.distance[static_cast<std::size_t>(v)] > ring) outside.push_back(v);
    }
    // The apex: the farthest, the nearest, and some between.
    const std::size_t stride = std::max<std::size_t>(1, outside.size() / 6);
    for (std::size_t i = 0; i < outside.size(); i += stride) {
      Targets targets = stay(vertex_count(search));
      for (const auto v : outside) targets[static_cast<std::size_t>(v)] = outside[i];
      if (offer_merge(search, targets)) return;
    }
  }
}

void cut_and_close(ReductionSearch& search) {
  for (int ring = 0; ring < rings_of(search).farthest && !search.ended(); ++ring) {
    const Rings rings = rings_of(search);
    const auto triangles = triangles_of(search.best());
    std::vector<std::uint8_t> keep(triangles.size(), 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const auto v : triangles[t]) {
        if (rings.distance[static_cast<std::size_t>(v)] > ring) keep[t] = 0;
      }
    }
    const auto cut = keep_triangles(search.best(), keep);
    if (cut.triangles.rows() == 0) continue;
    for (std::size_t corner = 0; corner < most_corners; ++corner) {
      if (search.offer(close_loops(cut, corner))) return;
    }
  }
}

void merge_balls(ReductionSearch& search) {
  for (const int radius : {3, 2, 1}) {
    const auto size = [&] { return balls(rings_of(search), radius).size(); };
    try_halves(search, size, [&](std::size_t begin, std::size_t end) {
      const auto all = balls(rings_of(search), radius);
      Targets targets = stay(vertex_count(search));
      for (std::size_t i = begin; i < end; ++i) {
        for (const auto v : all[i]) targets[static_cast<std::size_t>(v)] = all[i].front();
      }
      return offer_merge(search, targets);
    });
  }
}

void collapse_to_parents(ReductionSearch& search) {
  const auto size = [&] { return vertex_count(search); };
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    const Rings rings = rings_of(search);
    Targets targets = stay(size());
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<std::size_t>(rings.far_first[i]);
      targets[v] = rings.parent[v];
    }
    return offer_merge(search, targets);
  });
}

void collapse_edges(ReductionSearch& search) {
  // Vertices that share no edge may be merged too; where there are few this is cheap to try.
  constexpr std::size_t few = 16;
  for (std::size_t i = 0; i < vertex_count(search) && !search.ended();) {
    const Rings rings = rings_of(search);
    const auto u = rings.far_first[i];
    const auto n = vertex_count(search);
    const Targets near = n <= few ? stay(n) : rings.neighbours[static_cast<std::size_t>(u)];
    const bool smaller = std::any_of(near.begin(), near.end(), [&](std::int32_t v) {
      if (v == u) return false;
      Targets targets = stay(n);
      targets[static_cast<std::size_t>(u)] = v;
      return offer_merge(search, targets);
    });
    if (!smaller) ++i;
  }
}

void merge_twice(ReductionSearch& search) {
  constexpr std::size_t few = 10;
  const auto n = static_cast<std::int32_t>(vertex_count(search));
  if (vertex_count(search) > few) return;
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      for (std::int32_t to_a = 0; to_a < n; ++to_a) {
        for (std::int32_t to_b = 0; to_b < n; ++to_b) {
          if (to_a == a || to_b == b || (to_a == b && to_b == a)) continue;
          Targets targets = stay(vertex_count(search));
          targets[static_cast<std::size_t>(a)] = to_a;
          targets[static_cast<std::size_t>(b)] = to_b;
          if (offer_merge(search, targets)) return;
        }
      }
    }
  }
}

void remove_and_close(ReductionSearch& search) {
  // The star of a vertex, closed by a fan from any vertex of its rim.
  for (std::size_t i = 0; i < vertex_count(search) && !search.ended();) {
    const auto v = rings_of(search).far_first[i];
    const auto triangles = triangles_of(search.best());
    std::vector<std::uint8_t> keep(triangles.size(), 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (std::count(triangles[t].begin(), triangles[t].end(), v) > 0) keep[t] = 0;
    }
    const auto open = keep_triangles(search.best(), keep);
    bool smaller = false;
    for (std::size_t corner = 0; open.triangles.rows() > 0 && corner < most_corners; ++corner) {
      if ((smaller = search.offer(close_loops(open, corner)))) break;
    }
    if (!smaller) ++i;
  }
}

}  // namespace assay::properties
