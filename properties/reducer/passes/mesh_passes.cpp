// Passes that drop triangles: some keep a closed mesh closed, others do not. Also the cut of a mesh
// of very many triangles (reducer/search.h).
#include <algorithm>
#include <vector>

#include "detector/mesh/topology.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/search.h"

namespace assay::properties {
namespace {

constexpr std::size_t most_for_the_passes = 1000;

std::size_t triangle_count(const ReductionSearch& search) {
  return static_cast<std::size_t>(search.best().triangles.rows());
}

// Returns the middle of a triangle over all frames.
Eigen::RowVector3d middle_of(const Case& c, std::int32_t triangle) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const auto& frame : c.frames) {
    for (int k = 0; k < 3; ++k) sum += frame.row(c.triangles(triangle, k));
  }
  return sum / (3. * static_cast<double>(c.frames.size()));
}

// Returns the triangles of the best case: those of the reported pair first, then the others by
// their distance from it. If there is no pair, the first triangle stands for it.
std::vector<std::int32_t> near_first(const ReductionSearch& search) {
  const auto& c = search.best();
  auto focus = search.finding().focus;
  if (focus.empty()) focus.push_back(0);
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  for (const auto t : focus) centre += middle_of(c, t) / static_cast<double>(focus.size());
  auto order = in_order(triangle_count(search));
  std::vector<double> distance;
  for (const auto t : order) distance.push_back((middle_of(c, t) - centre).squaredNorm());
  for (const auto t : focus) distance[at(t)] = -1;
  std::ranges::stable_sort(order,
                           [&](auto a, auto b) { return distance[at(a)] < distance[at(b)]; });
  return order;
}

// Offers the triangles at the places [0, begin) and [end, ...) of the order.
bool offer_without(ReductionSearch& search, const std::vector<std::int32_t>& order,
                   std::size_t begin, std::size_t end) {
  std::vector<std::uint8_t> keep(order.size(), 1);
  for (std::size_t i = begin; i < end; ++i) keep[at(order[i])] = 0;
  return search.offer(keep_triangles(search.best(), keep));
}

// Keeps the triangles around the pair: four times as many each time, until the case fails; then the
// least number between the last two with which it still fails.
void keep_the_nearest(ReductionSearch& search) {
  constexpr std::size_t fewest = 8, times = 4;
  std::size_t passes = 0;
  for (std::size_t count = fewest; count < triangle_count(search) && !search.has_ended();
       count *= times) {
    const auto order = near_first(search);
    if (offer_without(search, order, count, order.size())) break;
    passes = count;
  }
  while (triangle_count(search) > passes + 1 && triangle_count(search) > most_for_the_passes &&
         !search.has_ended()) {
    const auto order = near_first(search);
    const std::size_t middle = passes + (order.size() - passes) / 2;
    if (!offer_without(search, order, middle, order.size())) passes = middle;
  }
}

// Leaves out a half, or a quarter, wherever it lies. Returns whether that made the mesh smaller.
bool leave_out_parts(ReductionSearch& search) {
  for (const std::size_t parts : {2, 4}) {
    for (std::size_t part = 0; part < parts && !search.has_ended(); ++part) {
      const auto order = near_first(search);
      const auto place = [&](std::size_t p) { return p * order.size() / parts; };
      if (offer_without(search, order, place(part), place(part + 1))) return true;
    }
  }
  return false;
}

}  // namespace

std::size_t cut_large_mesh(ReductionSearch& search) {
  if (triangle_count(search) <= most_for_the_passes) return 0;
  search.match_kind_alone(true);
  do {
    keep_the_nearest(search);
  } while (triangle_count(search) > most_for_the_passes && leave_out_parts(search));
  search.match_kind_alone(false);
  const bool is_known = !search.has_ended() && triangle_count(search) > most_for_the_passes;
  return is_known ? triangle_count(search) : 0;
}

namespace {

using detector::make_topology;

// Returns the triangles, those farthest from the focus first.
std::vector<std::int32_t> far_triangles_first(const ReductionSearch& search) {
  const Rings rings = rings_of(search);
  const auto triangles = triangles_of(search.best());
  auto order = in_order(triangles.size());
  std::vector<int> distance(triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const auto v : triangles[t]) {
      distance[t] = std::max(distance[t], rings.distance[at(v)]);
    }
  }
  std::ranges::stable_sort(order,
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
    std::vector<std::uint8_t> keep(triangle_count(search), 1);
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
  const auto size = [&] { return triangle_count(search); };
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    const auto order = far_triangles_first(search);
    return end - begin < order.size() && offer_without(search, order, begin, end);
  });
}

void drop_unused_vertices(ReductionSearch& search) {
  search.offer(with_triangles(search.best(), triangles_of(search.best())));
}

void drop_ghosts(ReductionSearch& search) {
  if (!search.best().ghosts) return;
  Case without = search.best();
  without.ghosts.reset();
  search.offer(without);
}

// Smaller meshes that stay closed where they are closed; reducer/search.h tells what each pass
// does. All passes but the cuts identify vertices (merge_vertices), under which a cycle stays one.

namespace {

bool offer_merge(ReductionSearch& search, const Numbers& targets) {
  return search.offer(merge_vertices(search.best(), targets));
}

// Groups the vertices outside the focus. A group holds a centre, which comes first, and vertices
// within `radius` edges of it. Each vertex is in one group at most, and groups of a single vertex
// are left out.
std::vector<std::vector<std::int32_t>> balls(const Rings& rings, int radius) {
  std::vector<std::uint8_t> is_taken(rings.distance.size(), 0);
  std::vector<std::vector<std::int32_t>> all;
  for (const auto centre : rings.far_first) {
    if (is_taken[at(centre)] != 0 || rings.distance[at(centre)] == 0) {
      continue;
    }
    is_taken[at(centre)] = 1;
    std::vector<std::int32_t> ball = {centre};
    std::size_t begin = 0;
    for (int r = 0; r < radius; ++r) {
      for (const std::size_t end = ball.size(); begin < end; ++begin) {
        for (const auto v : rings.neighbours[at(ball[begin])]) {
          if (is_taken[at(v)] != 0 || rings.distance[at(v)] == 0) continue;
          is_taken[at(v)] = 1;
          ball.push_back(v);
        }
      }
    }
    if (ball.size() > 1) all.push_back(std::move(ball));
  }
  return all;
}

// In loops of up to this length every corner is tried as the place of the fan.
constexpr std::size_t most_corners = 12;

}  // namespace

void cone_outside(ReductionSearch& search) {
  for (int ring = 0; ring <= rings_of(search).farthest && !search.has_ended(); ++ring) {
    const Rings rings = rings_of(search);
    std::vector<std::int32_t> outside;
    for (const auto v : rings.far_first) {
      if (rings.distance[at(v)] > ring) outside.push_back(v);
    }
    // The farthest vertex, the nearest, and some between are tried as apexes.
    const std::size_t stride = std::max<std::size_t>(1, outside.size() / 6);
    for (std::size_t i = 0; i < outside.size(); i += stride) {
      Numbers targets = in_order(vertex_count(search.best()));
      for (const auto v : outside) targets[at(v)] = outside[i];
      if (offer_merge(search, targets)) return;
    }
  }
}

void cut_and_close(ReductionSearch& search) {
  for (int ring = 0; ring < rings_of(search).farthest && !search.has_ended(); ++ring) {
    const auto part = within(search.best(), rings_of(search), ring);
    if (part.triangles.rows() == 0) continue;
    for (std::size_t corner = 0; corner < most_corners; ++corner) {
      if (search.offer(close_loops(part, corner))) return;
    }
  }
}

void merge_balls(ReductionSearch& search) {
  for (const int radius : {3, 2, 1}) {
    const auto size = [&] { return balls(rings_of(search), radius).size(); };
    try_halves(search, size, [&](std::size_t begin, std::size_t end) {
      const auto all = balls(rings_of(search), radius);
      Numbers targets = in_order(vertex_count(search.best()));
      for (std::size_t i = begin; i < end; ++i) {
        for (const auto v : all[i]) targets[at(v)] = all[i].front();
      }
      return offer_merge(search, targets);
    });
  }
}

void collapse_to_parents(ReductionSearch& search) {
  const auto size = [&] { return vertex_count(search.best()); };
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    const Rings rings = rings_of(search);
    Numbers targets = in_order(size());
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = at(rings.far_first[i]);
      targets[v] = rings.parent[v];
    }
    return offer_merge(search, targets);
  });
}

void collapse_edges(ReductionSearch& search) {
  // Vertices that share no edge may be merged too. If there are few vertices, this is cheap to
  // try.
  constexpr std::size_t few = 16;
  for (std::size_t i = 0; i < vertex_count(search.best()) && !search.has_ended();) {
    const Rings rings = rings_of(search);
    const auto u = rings.far_first[i];
    const auto n = vertex_count(search.best());
    const Numbers near = n <= few ? in_order(n) : rings.neighbours[at(u)];
    const bool smaller = std::ranges::any_of(near, [&](std::int32_t v) {
      if (v == u) return false;
      Numbers targets = in_order(n);
      targets[at(u)] = v;
      return offer_merge(search, targets);
    });
    if (!smaller) ++i;
  }
}

void merge_twice(ReductionSearch& search) {
  constexpr std::size_t few = 10;
  const auto n = static_cast<std::int32_t>(vertex_count(search.best()));
  if (vertex_count(search.best()) > few) return;
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      for (std::int32_t to_a = 0; to_a < n; ++to_a) {
        for (std::int32_t to_b = 0; to_b < n; ++to_b) {
          if (to_a == a || to_b == b || (to_a == b && to_b == a)) continue;
          Numbers targets = in_order(vertex_count(search.best()));
          targets[at(a)] = to_a;
          targets[at(b)] = to_b;
          if (offer_merge(search, targets)) return;
        }
      }
    }
  }
}

void remove_and_close(ReductionSearch& search) {
  // Removes the star of a vertex, and closes the hole by a fan from a vertex of its rim.
  for (std::size_t i = 0; i < vertex_count(search.best()) && !search.has_ended();) {
    const auto v = rings_of(search).far_first[i];
    const auto triangles = triangles_of(search.best());
    std::vector<std::uint8_t> keep(triangles.size(), 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (std::ranges::count(triangles[t], v) > 0) keep[t] = 0;
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
