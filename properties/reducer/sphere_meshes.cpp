#include "properties/reducer/sphere_meshes.h"

#include <algorithm>
#include <set>

namespace assay::properties {
namespace {

using Corners = std::array<std::int32_t, 3>;

// Brings a mesh into its canonical form: each triangle begins with its lowest corner, and the
// triangles ascend. Of the two orientations it takes the one in which the first triangle has its
// second corner before the third.
SphereMesh canonical(SphereMesh mesh) {
  const auto sort = [](SphereMesh& m) {
    for (Corners& corners : m) {
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    }
    std::sort(m.begin(), m.end());
  };
  sort(mesh);
  SphereMesh other = mirrored(mesh);
  sort(other);
  return std::min(mesh, other);
}

// A double pyramid: n-2 vertices around the middle, and the last two at the tips.
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
  std::vector<SphereMesh> found = {canonical(bipyramid(vertices))};
  std::set<SphereMesh> known(found.begin(), found.end());
  for (std::size_t next = 0; next < found.size(); ++next) {
    const SphereMesh mesh = found[next];
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        auto other = flipped(mesh, t, i);
        if (other.empty()) continue;
        other = canonical(std::move(other));
        if (known.insert(other).second) found.push_back(std::move(other));
      }
    }
  }
  return found;
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
    if (std::count(corners.begin(), corners.end(), a) > 0 &&
        std::count(corners.begin(), corners.end(), b) > 0) {
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

}  // namespace assay::properties
