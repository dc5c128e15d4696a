#include "detector/traditional/sample_patches.h"

#include <algorithm>

namespace assay::detector {
namespace {

constexpr std::size_t size_of_small = 12, size_of_medium = 36, size_of_large = 96;

// At most `most` triangles, found from `seed` across edges.
std::vector<std::int32_t> triangles_around(const Topology& mesh, std::int32_t seed,
                                           std::size_t most) {
  std::vector<std::int32_t> patch = {seed};
  for (std::size_t i = 0; i < patch.size(); ++i) {
    for (const auto e : mesh.triangle_edges[at(patch[i])]) {
      for (const auto t : mesh.edge_triangles.row(e)) {
        if (patch.size() == most) return patch;
        if (std::find(patch.begin(), patch.end(), t) == patch.end()) patch.push_back(t);
      }
    }
  }
  return patch;
}

// The directed edges of the triangles after opposite ones have cancelled.
std::vector<DirectedEdge> boundary_of(const Topology& mesh, std::span<const std::int32_t> patch) {
  std::vector<DirectedEdge> boundary;
  for (const auto t : patch) {
    const auto& corners = mesh.triangles[at(t)];
    for (std::size_t i = 0; i < 3; ++i) {
      const bool falls = corners[(i + 1) % 3] > corners[(i + 2) % 3];
      const DirectedEdge edge = 2 * mesh.triangle_edges[at(t)][i] + (falls ? 1 : 0);
      const auto opposite = std::find(boundary.begin(), boundary.end(), edge ^ 1);
      if (opposite == boundary.end()) {
        boundary.push_back(edge);
      } else {
        boundary.erase(opposite);
      }
    }
  }
  return boundary;
}

std::vector<SamplePatch> spread(const Topology& mesh, ContourMaker& maker, std::size_t count,
                                std::size_t size) {
  std::vector<SamplePatch> patches(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto seed = (2 * i + 1) * mesh.triangles.size() / (2 * count);
    patches[i].triangles = triangles_around(mesh, static_cast<std::int32_t>(seed), size);
    maker.append(boundary_of(mesh, patches[i].triangles), patches[i].contour);
  }
  return patches;
}

}  // namespace

SamplePatches sample_patches(const Topology& mesh, ContourMaker& maker) {
  const std::size_t small = std::clamp<std::size_t>(mesh.triangles.size() / 512, 4, 32);
  return {spread(mesh, maker, small, size_of_small), spread(mesh, maker, small / 2, size_of_medium),
          spread(mesh, maker, small / 4, size_of_large)};
}

}  // namespace assay::detector
