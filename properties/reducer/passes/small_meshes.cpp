// Passes that try triangulated spheres over a few vertices of the case itself (reducer/search.h).
//
// The four moving points of a contact, taken as a tetrahedron, have the same contact at the same
// time. So if the failure lies in how a contact is looked for, a tetrahedron is often the whole
// reduction.
#include <algorithm>
#include <set>

#include "properties/reducer/case_edits.h"
#include "properties/reducer/search.h"

namespace assay::properties {
namespace {

using Corners = std::array<std::int32_t, 3>;

// Brings a mesh into its canonical form: each triangle begins with its lowest corner, and the
// triangles ascend. Of the two orientations it takes the one in which the first triangle has its
// second corner before the third.
SphereMesh canonical(SphereMesh mesh) {
  const auto sort = [](SphereMesh& m) {
    for (Corners& corners : m) {
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
    std::ranges::sort(m);
  };
  sort(mesh);
  SphereMesh other = mirrored(mesh);
  sort(other);
  return std::min(mesh, other);
}

// Returns a double pyramid: n-2 vertices around the middle, and the last two at the tips.
SphereMesh bipyramid(int vertices) {
  SphereMesh mesh;
  const std::int32_t around = vertices - 2;
  for (std::int32_t i = 0; i < around; ++i) {
    mesh.push_back({i, (i + 1) % around, around});
    mesh.push_back({(i + 1) % around, i, around + 1});
  }
  return mesh;
}

std::vector<SphereMesh> all_by_flips(int vertices) {
  if (vertices == 4) return {canonical({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})};
  std::vector<SphereMesh> meshes = {canonical(bipyramid(vertices))};
  std::set<SphereMesh> known_meshes(meshes.begin(), meshes.end());
  for (std::size_t next = 0; next < meshes.size(); ++next) {
    const SphereMesh mesh = meshes[next];
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        auto other = flipped(mesh, t, i);
        if (other.empty()) continue;
        other = canonical(std::move(other));
        if (known_meshes.insert(other).second) meshes.push_back(std::move(other));
      }
    }
  }
  return meshes;
}

}  // namespace

SphereMesh mirrored(SphereMesh mesh) {
  for (Corners& corners : mesh) std::swap(corners[1], corners[2]);
  return mesh;
}

SphereMesh flipped(const SphereMesh& mesh, std::size_t t, std::size_t i) {
  const std::int32_t u = mesh[t][i], v = mesh[t][(i + 1) % 3], a = mesh[t][(i + 2) % 3];
  std::size_t other = mesh.size();
  std::int32_t b = -1;
  for (std::size_t s = 0; s < mesh.size(); ++s) {
    for (std::size_t k = 0; k < 3 && s != t; ++k) {
      const std::int32_t x = mesh[s][k], y = mesh[s][(k + 1) % 3];
      if ((x == u && y == v) || (other != mesh.size() && x == v && y == u)) return {};
      if (x != v || y != u) continue;
      other = s;
      b = mesh[s][(k + 2) % 3];
    }
  }
  if (b < 0 || b == a) return {};
  for (const Corners& corners : mesh) {
    if (std::ranges::count(corners, a) > 0 && std::ranges::count(corners, b) > 0) {
      return {};
    }
  }
  SphereMesh result = mesh;
  result[t] = {a, u, b};
  result[other] = {a, b, v};
  return result;
}

const std::vector<SphereMesh>& sphere_meshes(int vertices) {
  static const std::array<std::vector<SphereMesh>, 4> all = {all_by_flips(4), all_by_flips(5),
                                                             all_by_flips(6), all_by_flips(7)};
  return all.at(static_cast<std::size_t>(vertices - 4));
}

namespace {

// Calls `take` with each subset of `count` of the first `pool` places, in ascending order. Ends
// when `take` returns true.
template <class Take>
bool any_subset(std::size_t pool, std::size_t count, Take take) {
  std::vector<std::size_t> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = i;
  while (true) {
    if (take(places)) return true;
    std::size_t i = count;
    while (i > 0 && places[i - 1] == pool - count + i - 1) --i;
    if (i == 0) return false;
    ++places[i - 1];
    for (std::size_t k = i; k < count; ++k) places[k] = places[k - 1] + 1;
  }
}

bool holds_all(const SphereMesh& mesh, const std::vector<Corners>& triangles) {
  return std::ranges::all_of(triangles, [&](const Corners& corners) {
    return std::ranges::any_of(
        mesh, [&](const Corners& other) { return as_set(other) == as_set(corners); });
  });
}

void try_spheres(ReductionSearch& search, bool of_pair_only) {
  constexpr std::size_t largest_pool = 8;
  // From this number of vertices on there are too many spheres, and only those that hold the
  // reported triangles are tried.
  constexpr std::size_t many = 6;
  Rings rings = rings_of(search);
  const Case start = search.best();
  std::vector<std::int32_t> pool(rings.far_first.rbegin(), rings.far_first.rend());  // near first
  if (pool.size() > largest_pool) pool.resize(largest_pool);
  if (of_pair_only) {
    std::erase_if(pool, [&](std::int32_t v) { return rings.distance[at(v)] > 0; });
  }

  for (std::size_t n = 4; n <= std::min<std::size_t>(7, pool.size()); ++n) {
    if (search.size().triangles <= 2 * n - 4) return;
    const bool smaller = any_subset(pool.size(), n, [&](const std::vector<std::size_t>& places) {
      std::vector<std::int32_t> place(static_cast<std::size_t>(start.frames.front().rows()), -1);
      for (std::size_t i = 0; i < n; ++i) {
        place[at(pool[places[i]])] = static_cast<std::int32_t>(i);
      }
      std::vector<Corners> triangles;
      if (n >= many) {
        if (search.finding().focus.size() < 2) return true;
        for (const auto t : search.finding().focus) {
          Corners corners;
          for (int i = 0; i < 3; ++i) {
            corners[at(i)] = place[at(start.triangles(t, i))];
          }
          if (as_set(corners)[0] < 0) return false;
          triangles.push_back(corners);
        }
      }
      for (const SphereMesh& sphere : sphere_meshes(static_cast<int>(n))) {
        if (!holds_all(sphere, triangles)) continue;
        for (SphereMesh mesh : {sphere, mirrored(sphere)}) {
          if (search.has_ended()) return true;
          for (Corners& corners : mesh) {
            for (auto& v : corners) v = pool[places[at(v)]];
          }
          const Case small = with_triangles(start, mesh);
          if (search.offer(small)) return true;
          // The view of the large mesh need not suit the small one, so the small one is also tried
          // with a view of its own.
          if (n < many && search.offer(seen_from_its_middle(small))) return true;
        }
      }
      return false;
    });
    if (smaller && search.size().triangles < static_cast<std::size_t>(start.triangles.rows())) {
      return;
    }
  }
}

}  // namespace

void try_spheres_of_pair(ReductionSearch& search) { try_spheres(search, true); }

void try_small_spheres(ReductionSearch& search) { try_spheres(search, false); }

}  // namespace assay::properties
